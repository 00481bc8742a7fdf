// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

// Courses that lean or bend each in its own way. Knows nothing of gears.
namespace trueflank::loop {

/// A line or a bow of every course's own.
struct OwnTrend {
  int degree = 0;        ///< 1: line, 2: bow
  double p_value = 1.0;  ///< corrected for both
  /// Standard deviation from course to course: of the line from end to end, of the bow from its
  /// middle to its ends.
  double spread = 0.0;
};

/// The surer of the two, where the courses of the sets (one a column, the same places in the rows)
/// differ by more of it than errors that hang together would do: what stands in polynomials of the
/// degrees above is continued to it by a power law, as steep as those degrees allow, and twice and
/// a half that is still an error. What all courses of a set have in common does not count. Empty of
/// fewer than three courses in every set, or fewer than 16 places.
/// Accuracy: of errors without trends (white, hanging together over a point to half the course,
/// white beside a random walk, of power laws) at most 1 of 100 data sets at the level of 0.004; a
/// line of three times the error, with a standard deviation from course to course of so much at its
/// ends, is found on four courses of either set in 8 of 10 or more, if errors do not hang together.
[[nodiscard]] std::optional<OwnTrend> own_trend(const std::vector<Eigen::MatrixXd>& sets);

}  // namespace trueflank::loop
