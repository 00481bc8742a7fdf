// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/cure/design_change.h"

// What the joint cure tries, each list from small to large.
namespace trueflank {

/// Centre distance, backlash, root rounding and addendum together; the first changes nothing. Where
/// the distance is far from that of a mesh without shifts, as one mistyped, that too, and half way
/// there.
[[nodiscard]] std::vector<DesignChange> common_moves(const GearTrain& train);
/// Shifts of a layer; the first is 0.
[[nodiscard]] const std::vector<double>& shift_moves();
/// The same in larger steps, for other teeth.
[[nodiscard]] const std::vector<double>& coarse_shift_moves();
/// Tooth counts and planets, few teeth more or less, as one that assembles may need; at the present
/// centre distance and, where that is far, at that of the teeth.
[[nodiscard]] std::vector<DesignChange> teeth_moves(const GearTrain& train);
/// Neighbouring planets run into each other by more than shorter tips could clear.
[[nodiscard]] bool planets_collide(const GearTrain& laid);

}  // namespace trueflank
