// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// Widens intervals of effects that were told to hold what they are with another effect in the
/// place of one of them, where the data do not tell the two apart (a zero of the input's sensor or
/// of the output's; a scale or a friction that differs between the directions): either may be the
/// truth, and the others' figures differ more than their errors. The other set must leave no more
/// than chance (chi-square 4) and have possible signs. The selection's state is as before.
/// True where what follows the run leaves surely less than an effect that follows the temperature.
[[nodiscard]] bool hold_exchanged_effects(DriveSelection& selection, const std::vector<DriveEffect>& effects,
                            std::vector<FoundEffect>& found);

}  // namespace trueflank::loop
