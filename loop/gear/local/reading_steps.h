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
  /// The same, but nearly normal and with a variance of half the step's square: beside it even a
  /// single trace whose values hardly leave one level scatters as the others do. For what is judged
  /// one trace at a time, and for figures that the added variance is taken off again.
  [[nodiscard]] double wide_spread_um(const Observations& table, std::size_t row) const;
  /// The variance that it adds; 0 where values were read finely.
  [[nodiscard]] double wide_variance(ObservationKind kind, int source) const;

 private:
  [[nodiscard]] double step_um(const Observations& table, std::size_t row) const;
  std::map<std::pair<int, int>, double> step_um_;  ///< coarse ones, by kind and source
};

}  // namespace trueflank::loop
