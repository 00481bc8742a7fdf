// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "trueflank/loop/drive/bench_visits.h"

// What a model leaves of a bench, asked apart from all candidates before it is called noise.
namespace trueflank::loop {

struct BenchRemainder {
  double p_value = 1.0;  ///< of what is left being noise, corrected for all that was asked
  double share = 0.0;    ///< of what is left that what was found carries, by squares
  double noise_nm =
      kNaN;             ///< random error without it, plain root mean square; NaN: nothing was found
  std::string follows;  ///< "follows the speed: ..."; empty: nothing was found
  Eigen::VectorXd structure_nm;  ///< of every row, as found; empty: nothing was found
};

/// Asks whether what is left is the same at visits of one set point, load, speed, temperature,
/// direction, way of loading or file that are far apart in time (sign flips of visits, in blocks
/// where the errors hang together), and whether it moves slowly over the run (the slowest waves
/// against the faster ones). Visits' errors must be symmetric; nothing else is assumed. Fixed seed.
[[nodiscard]] BenchRemainder ask_remainder(const BenchTable& table, double ratio,
                                           const Eigen::VectorXd& left_nm);

}  // namespace trueflank::loop
