// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

// The variance of single values from how they differ from their neighbours.

namespace trueflank::loop {

/// A value of a trace, or the mean of some that follow each other.
struct OnTrace {
  double at_mm = 0.0;  ///< roll length or height
  double um = 0.0;
  double loud_square = 1.0;  ///< how much larger its variance is than that of the others
};

/// Squares [um^2] of values against the lines through those before and after them, each over what
/// it has of the variance of one value: for traces of few values, whatever their distances.
[[nodiscard]] std::vector<double> squares_beside_lines(std::vector<OnTrace> values);

/// Variance from squares of a centred normal variable: by the median, or the mean of few. 0: there
/// are none.
[[nodiscard]] double robust_variance(std::vector<double>& squares);

/// True where one of two variances, medians of so many squares, is larger by more than chance.
[[nodiscard]] bool are_apart(const std::array<double, 2>& variance,
                             const std::array<std::size_t, 2>& counts);

}  // namespace trueflank::loop
