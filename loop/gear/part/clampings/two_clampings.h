// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// The teeth stand off the axis where this flank was measured.
[[nodiscard]] Effect clamping_of(FlankChoice flank);
/// The two names that two clampings look like together: an eccentricity, and a wave of pitch once
/// per turn.
[[nodiscard]] Effect eccentric();
[[nodiscard]] Effect wave_of_pitch();

/// True where nothing but an index and sizes was measured.
[[nodiscard]] bool is_index_alone(const Observations& table);

/// Of an index alone, an eccentricity and a wave of pitch once per turn are in all numbers what two
/// clampings make of it, one for the left flanks and one for the right ones: says the other with
/// either, and what is to be measured before anything is corrected.
void say_two_clampings(const FlankGeometry& geometry, const Observations& table,
                       const PointFit& fit, std::vector<FoundEffect>& effects);

}  // namespace trueflank::loop
