// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/local/repeating_patterns.h"

// Waves around the gear whose length changes evenly, in values one a tooth.
namespace trueflank::loop {

/// Shapes (unnamed_stretching_wave) that leave least of the values, the best first. None where
/// values of fewer teeth than two dozen are there.
[[nodiscard]] std::vector<EffectShape> stretching_waves(const FlankGeometry& geometry,
                                                        const ValuesOfTeeth& values, bool opposite,
                                                        std::size_t most);
/// How many it looks at.
[[nodiscard]] std::size_t stretching_waves_looked_at(int teeth);

}  // namespace trueflank::loop
