// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trueflank/loop/drive/bench_table.h"

namespace trueflank::loop {

/// What rows that lie near each other over what was recorded have in common of what is left: a form
/// that was not found, whatever its shape.
struct SharedByNearRows {
  double p_value = 1.0;    ///< of none of it being shared, corrected for all that was asked
  double share = 0.0;      ///< of the squares of what is left
  double noise_nm = kNaN;  ///< what is left without it, plain root mean square; NaN: none is shared
  double noise_error_nm = kNaN;  ///< standard error of that
  std::string told;              ///< over what, how much and where most; empty: none is shared
};

/// Asks rows near in speed, load, temperature, place of a turn, the load before, or two of these at
/// once. Rows that follow each other are not compared: errors may hang together. `orders`: times
/// per turn of the input at which something was found to come again.
/// Requires: errors of rows that do not follow each other are independent, and symmetric.
[[nodiscard]] SharedByNearRows ask_neighbours(const BenchTable& table, double ratio,
                                              const std::vector<double>& orders,
                                              const Eigen::VectorXd& left_nm);

}  // namespace trueflank::loop
