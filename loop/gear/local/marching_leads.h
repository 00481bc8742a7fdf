// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/local/flank_waves.h"

namespace trueflank::loop {

/// Waves over the face in the helix traces of few teeth, whose phase runs on from tooth to tooth by
/// a whole number of periods a turn: at most one of either side. None where the same on every
/// tooth, or another order, says nearly as much (teeth evenly spaced show several alike), or where
/// the waves are less than a third of the traces' squares. `row_um`: residuals of the rows; `used`:
/// which are asked.
[[nodiscard]] std::vector<FlankWaves> marching_leads(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const std::vector<float>& row_um,
                                                     const std::vector<bool>& used);

}  // namespace trueflank::loop
