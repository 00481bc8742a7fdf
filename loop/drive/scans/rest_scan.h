// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/drive/drive_effect.h"

// Where a loss dies away and comes again after as many rows: rests that no column tells.
namespace trueflank::loop {

struct LikeliestRest {
  double p_value = 1.0;  ///< corrected for all periods and starts that were tried
  double period = 0.0, phase = 0.0, rows = 0.0;
};

/// Every period that comes six times or more, every start and five lengths are tried on the
/// training rows of one file. Periods with which the loads or speeds come again are left out: what
/// follows these would look so.
[[nodiscard]] LikeliestRest likeliest_rest(const DriveContext& context,
                                           const Eigen::VectorXd& left);

/// Rows after which something may come again: from the shortest on, each at least six times in the
/// run. Without those with which the loads or speeds come again.
[[nodiscard]] std::vector<int> periods_of_rests(const std::vector<BenchPoint>& points);

}  // namespace trueflank::loop
