// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Values of traces that were read or printed in steps larger than their own scatter stand on a few
/// levels: most windows of such a trace are alike, and a few that are not look like a spot. Spread
/// evenly over their step they scatter as other values do, at the cost of the step's own scatter.
class ReadingSteps {
 public:
  /// `row_um`: residuals of the table's rows.
  ReadingSteps(const Observations& table, const std::vector<float>& row_um);
  /// What is added to the residual of a row [um]: within half a step, the same at every call;
  /// nothing where values were read finely.
  [[nodiscard]] double spread_um(const Observations& table, std::size_t row) const;

 private:
  std::map<std::pair<int, int>, double> step_um_;  ///< coarse ones, by kind and source
};

}  // namespace trueflank::loop
