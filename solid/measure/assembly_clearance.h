// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// Two bodies of an assembly that run into each other at some position of a turn, or do as they
/// stand.
struct Collision {
  std::string body1, body2;
  double depth_mm = 0.0;
};

struct AssemblyClearance {
  std::vector<Collision> collisions;
  /// Least gap between made parts that turn against each other, and whose it is; NaN: none turn.
  double least_gap_mm = kNaN;
  std::string body1, body2;
};

/// Every body of an assembly against every other, screws and bearings included, through all
/// positions: what turns about the axis is taken as the ring that it sweeps, a planet as the
/// cylinder of its tips. So it may find a collision that is none, and misses none, but for gears in
/// mesh, which it leaves aside (overlap judges those), and a shaft in its bore.
[[nodiscard]] AssemblyClearance assembly_clearance(const GearTrain& train,
                                                   const PartShapes& shapes);

/// The thinnest wall of a part: between two of its outlines at one height, up to the roots of
/// teeth.
struct ThinnestWall {
  double width_mm = kNaN;  ///< NaN: no outline has another beside it; negative: they cross
  double height_mm = 0.0;  ///< in the part, where it begins
};
[[nodiscard]] ThinnestWall thinnest_wall(const PartShape& part);

}  // namespace trueflank
