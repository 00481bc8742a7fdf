// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// Two round outlines of one layer, or of two layers where they meet, that cross each other: no solid
/// is bounded by them.
struct OutlineCrossing {
  double diameter1_mm = 0.0, diameter2_mm = 0.0;
  double depth_mm = 0.0;   ///< so far one would have to move, at least
  double height_mm = 0.0;  ///< in the part: lower face of the layer, or of the upper of the two
};

/// All of them, from below. Outlines with teeth, flats or corners are not looked at.
[[nodiscard]] std::vector<OutlineCrossing> outline_crossings(const PartShape& part);

/// The first of every part that has one: kInfeasible, the part's name as key.
[[nodiscard]] Errors crossing_outlines(const PartShapes& shapes);

}  // namespace trueflank
