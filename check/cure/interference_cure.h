// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// How far a pair is on the good side; a cure is where this becomes 0. NaN counts as bad. Cures ask for its sign
/// alone: one that knows no more may tell 0 and -1.
using PairMargin = std::function<double(const GearPair&)>;

/// A margin that is costly to ask, with a quick answer that is true wherever the margin is not negative: the
/// quick one seeks, the costly one verifies what was found, and seeks itself only where it disagrees.
struct CureMargin {
  PairMargin exact;
  std::function<bool(const GearPair&)> quick = {};  ///< empty: the exact one is quick
};

/// Tip circle radius nearest to the present one at which the margin is not negative, found by
/// bisection to 0.5 um; empty where shortening the teeth does not help.
[[nodiscard]] std::optional<double> tip_radius_cure_mm(const GearPair& pair, bool of_gear1,
                                                       const CureMargin& margin);

/// Profile shift by which the layer of a mesh must move (planets and rings up, sun or wheel down; the
/// backlash stays) so that the margin of the mesh is not negative; the smaller of both directions,
/// at most 1. Empty where there is none.
struct ShiftCure {
  double change = 0.0;   ///< of gear 1 of the mesh
  double shift1 = 0.0;   ///< of gear 1 then
  double shift2 = 0.0;   ///< of gear 2 then
};
[[nodiscard]] std::optional<ShiftCure> shift_cure(const GearTrain& train, const TrainMesh& mesh,
                                                  const CureMargin& margin);

/// Both cures in a sentence; `tip_of_gear1` says whose tip is to be shortened.
[[nodiscard]] std::string cure_text(const GearTrain& train, const TrainMesh& mesh, bool tip_of_gear1,
                                    const CureMargin& margin);

}  // namespace trueflank
