// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/design_change.h"

// What the joint cure tries, each list from small to large.
namespace trueflank {

/// Centre distance, backlash, root rounding and addendum together; the first changes nothing.
[[nodiscard]] std::vector<DesignChange> common_moves();
/// Shifts of a layer; the first is 0.
[[nodiscard]] const std::vector<double>& shift_moves();
/// Tooth counts and planets, few teeth more or less, as one that assembles may need.
[[nodiscard]] std::vector<DesignChange> teeth_moves(const GearTrain& train);

}  // namespace trueflank
