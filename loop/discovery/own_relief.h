// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

// Courses of which each has a smooth form of its own, beside errors of single values. Knows nothing
// of gears.
namespace trueflank::loop {

struct OwnRelief {
  double p_value = 1.0;
  double spread = 0.0;  ///< standard deviation of the forms, beyond the errors
  double waves = 0.0;   ///< the shortest that clearly stand out of the errors, over a course
};

/// Where long waves are many times as large as short ones, and these are as large at every length:
/// what hangs together by itself (errors of which each keeps a share of the last, a filter, a
/// random walk) falls on down to the shortest. By medians over the courses: one odd course is no
/// relief. `sets`: one course a column, the same places in the rows; what a set has in common is
/// taken off. Empty of fewer than three courses in every set, or fewer than 32 places.
[[nodiscard]] std::optional<OwnRelief> own_relief(const std::vector<Eigen::MatrixXd>& sets);

}  // namespace trueflank::loop
