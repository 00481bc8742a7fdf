// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/loop/gear/correction.h"

namespace trueflank::loop {

/// What a correction does to the teeth, of many places on all sides of many teeth. Lengths are
/// shares of what they are as designed.
struct CorrectionReach {
  double farthest_mm = 0.0;     ///< a wall moves
  double least_tooth = 1.0;     ///< that is left of a tooth's thickness at some diameter
  double least_gap = 1.0;       ///< that is left of a gap's width at some diameter
  double least_height = 1.0;    ///< that is left of the tooth from root to tip
  double most_stretched = 0.0;  ///< a flank becomes longer or shorter somewhere
  double steepest = 0.0;  ///< change of what moves the body along a flank, as a share of the way
  double least_radius_mm = 0.0, largest_radius_mm = 0.0;  ///< between which the teeth then lie
};
/// NaN where a displacement is no number.
[[nodiscard]] CorrectionReach reach_of(const Correction& correction);

/// Whether teeth can hold every effect alone and all of them together: walls move by a module at
/// most and a scale of the whole part is a quarter at most; a quarter of every tooth, gap, height
/// and flank stays. What lies beyond is a slip of units or a part for the bin, not a deviation a
/// process repeats. Errors: kInfeasible, key "effects.ID" of the effect, or of the largest, with
/// amount and bound.
[[nodiscard]] Status within_bounds(const Correction& correction);

}  // namespace trueflank::loop
