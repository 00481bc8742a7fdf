// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "trueflank/base/contract.h"

namespace trueflank::loop {

/// Standard deviation of normal values over the median of their sizes.
inline constexpr double kSigmaOfMedianSize = 1.4826;

/// The value at place n of the sorted ones, 0 the smallest. Reorders them.
template <class T>
[[nodiscard]] T nth_smallest(std::vector<T>& values, std::size_t n) {
  TRUEFLANK_EXPECTS(n < values.size());
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The middle value, of an even number the upper of the two; there must be one. Reorders them.
template <class T>
[[nodiscard]] T median(std::vector<T>& values) {
  return nth_smallest(values, values.size() / 2);
}
template <class T>
[[nodiscard]] T median(std::vector<T>&& values) {
  return median(values);
}

/// Standard deviation of normal values about zero, by the median of their sizes, so that few wild
/// ones do not matter. 0 where there are none.
template <class T>
[[nodiscard]] double robust_sigma(std::vector<T> values) {
  if (values.empty()) return 0.0;
  for (T& value : values) value = std::abs(value);
  return kSigmaOfMedianSize * static_cast<double>(median(values));
}

/// Fourth moment over the square of the second, less the 3 of normal values; of values about zero.
/// 0 where there are none.
template <class T>
[[nodiscard]] double excess_kurtosis(const std::vector<T>& values) {
  double squares = 0.0, fourths = 0.0;
  for (const T& value : values) {
    const double square = static_cast<double>(value) * static_cast<double>(value);
    squares += square;
    fourths += square * square;
  }
  return squares > 0.0 ? fourths * static_cast<double>(values.size()) / (squares * squares) - 3.0 : 0.0;
}

}  // namespace trueflank::loop
