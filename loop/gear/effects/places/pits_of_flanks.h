// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "trueflank/loop/gear/effect.h"

namespace trueflank::loop::gear_effects {

/// Shape values of many pits or lumps (unnamed_pits): how many were found, how many there are
/// likely with those that too few points met, and at most, how they are hollowed, and from there on
/// so many values of each. The amount is their mean depth.
enum PitsOfFlanks : std::size_t { kPitsFound, kPitsLikely, kPitsAtMost, kPitsHollow, kPitsValues };
/// Of one pit: on the flank `side` (+1 counter-clockwise) of a tooth, its width along the flank,
/// and its depth over the mean depth.
enum OnePit : std::size_t {
  kPitTooth,
  kPitSide,
  kPitDiameter,
  kPitHeight,
  kPitWidth,
  kPitDepth,
  kValuesOfPit
};
/// With a flat floor and steep walls; a bowl, as a cap of a ball; a bell, soft all over.
enum HollowOfPits { kFlatFloor, kBowl, kBell, kHollows };

/// Depth of a pit over that in its middle, where the square of the distance from there is so many
/// times that of half its width.
[[nodiscard]] double depth_of_pit(int hollow, double square);
/// From there on a pit has no depth.
inline constexpr double kEndOfPit = 1.8;  ///< times half its width

}  // namespace trueflank::loop::gear_effects
