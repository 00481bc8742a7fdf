// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trueflank/loop/discovery/course_scan.h"

namespace trueflank::loop {

/// The surest nick on one course of these sets (one a column, what is usual taken off, the scatter
/// of all alike): three values that follow each other and lie far off to one side, each by itself.
/// It is too short for windows, in which wild points would stand as well. The nearest of the three
/// tells; the more errors hang together, the nearer is its chance to that of one value. The p value
/// is corrected for all places, twice; 0.01 at most. `alike`: of each set, the correlation of
/// neighbours.
/// Accuracy: of a nick three values wide, 15 times the noise high at its middle, on traces of 41
/// values whose errors hang together by 0.6 from one to the next, six of six are found, of 10 times
/// two; docs/decisions/0540 has what noise alone does.
[[nodiscard]] std::optional<CourseFinding> nick_of(const std::vector<Eigen::MatrixXd>& apart,
                                                   const std::vector<double>& alike);

}  // namespace trueflank::loop
