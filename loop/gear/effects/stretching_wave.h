// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Waves from tooth to tooth whose length changes evenly: unnamed_stretching_wave.
namespace trueflank::loop::gear_effects {

/// How many there are a turn, at either end: each goes over three teeth or more.
inline constexpr double kFewestOfStretching = 1.0;
[[nodiscard]] constexpr double most_of_stretching(int teeth) { return teeth / 3.0; }

}  // namespace trueflank::loop::gear_effects
