// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {

/// The vertices of a circle's or bore's bed chamfer: the same places of the outline at every height.
struct BedRows {
  std::vector<double> heights_mm;         ///< of the part; from 0 to the chamfer's height
  std::vector<std::vector<Point2>> rows;  ///< one a height; joined straight up
  double chord_error_mm = 0.0;  ///< bound on the distance of facets and surface, and of the wall above
};

/// Requires: an outline without teeth that has a bed chamfer; tolerance_mm > 0.
[[nodiscard]] BedRows bed_rows(const Outline& outline, double tolerance_mm);

}  // namespace trueflank
