// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

struct DriftOfTraces {
  EffectShape shape;  ///< of unnamed_drift_of_traces (effects/drift_of_traces.h)
  double amount_um = 0.0;
  double p_value = 1.0;  ///< corrected for the orders looked at
  /// Squares of heights that it leaves, and of what an even drift over the gear's turn from its
  /// first tooth leaves.
  double left = 0.0, left_by_turn = 0.0;
  double heights = 0.0;  ///< how many
};

/// A drift of the heights of traces that share one zero, in the order of their teeth; none where
/// they are few, where other records stand beside them, where their heights do not follow it
/// closely, or follow a wave once or twice a turn as well. `row_um`: what is left in every row of
/// the table.
[[nodiscard]] std::optional<DriftOfTraces> drift_of_traces(const FlankGeometry& geometry,
                                                           const Observations& table,
                                                           const std::vector<float>& row_um);

}  // namespace trueflank::loop
