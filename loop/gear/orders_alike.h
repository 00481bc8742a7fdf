// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/fit/point_fit.h"

namespace trueflank::loop {

/// Teeth that were traced, where nothing but traces shows forms of the flanks; else empty.
[[nodiscard]] std::vector<int> traced_teeth(const Observations& table);

/// Waves per turn, up to eight, that would look like an effect of the fit on the teeth that were
/// traced: six teeth evenly spaced show a lean of all teeth and one that comes six times per
/// turn alike. Empty for effects that move the body, and where an index or runout of all teeth
/// shows the effect too.
[[nodiscard]] std::vector<int> orders_alike(const FlankGeometry& geometry,
                                            const Observations& table, const PointFit& fit,
                                            int effect);

/// "waves 4 and 8 times per turn"
[[nodiscard]] std::string waves_in_words(const std::vector<int>& orders);

}  // namespace trueflank::loop
