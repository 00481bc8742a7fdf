// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/observations.h"
#include "trueflank/loop/gear/plane/part_of_plane.h"

// Parts of the plane where all flanks stand out or lie back alike.
namespace trueflank::loop {

struct LikeliestPart {
  PartOfPlane part;
  double p_value = 1.0;  ///< of what bounds leave on single flanks, corrected for all parts
  double square = 0.0;   ///< squares that it takes out of all rows
  double amount_um = 0.0;
};

/// Where the bounds of a part may lie.
enum class BoundsOfPart {
  kCrossFlanks,       ///< what stands on whole flanks or teeth is none
  kInGapsAndTeethToo  ///< sharp ones, too, that part whole flanks, where no crossed flank denies it
};

/// The strip, half plane or disc that takes most out of scanned flanks. What its bounds leave on
/// each flank that they cross must say the same as all of it. `row_um`: residuals of the table's
/// rows; `used`: which rows are looked at.
[[nodiscard]] std::optional<LikeliestPart> likeliest_part_of_plane(const FlankGeometry& geometry,
                                                                   const Observations& table,
                                                                   const std::vector<float>& row_um,
                                                                   const std::vector<bool>& used,
                                                                   BoundsOfPart bounds);

}  // namespace trueflank::loop
