// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/base/contract.h"

namespace trueflank::loop {

/// Standard deviation of normal values over the median of their sizes.
inline constexpr double kSigmaOfMedianSize = 1.4826;
/// Median of squares of normal values over their variance.
inline constexpr double kMedianOfSquare = 0.4549;

/// As nth_smallest, of many values: two values of a sample bound where it lies, and only what lies
/// between them is put in order. Nothing where the sample misleads.
template <class T>
[[nodiscard]] std::optional<T> nth_within_bounds(const std::vector<T>& values, std::size_t n) {
  constexpr std::size_t kEvery = 16;
  std::vector<T> sample;
  sample.reserve(values.size() / kEvery + 1);
  for (std::size_t i = 0; i < values.size(); i += kEvery) sample.push_back(values[i]);
  // four standard errors of a place in the sample, where they are largest: in the middle
  const auto margin = static_cast<std::size_t>(2.0 * std::sqrt(static_cast<double>(sample.size())));
  const std::size_t expected = n / kEvery;
  const bool has_low = expected > margin, has_high = expected + margin < sample.size();
  auto low = sample.begin(), high = sample.end();
  if (has_low) {
    low += static_cast<std::ptrdiff_t>(expected - margin);
    std::nth_element(sample.begin(), low, sample.end());
  }
  if (has_high) {
    high = sample.begin() + static_cast<std::ptrdiff_t>(expected + margin);
    std::nth_element(low, high, sample.end());
  }
  const T least = has_low ? *low : std::numeric_limits<T>::lowest(),
          most = has_high ? *high : std::numeric_limits<T>::max();
  // (without branches, which nothing could foretell)
  constexpr std::size_t kAtOnce = 1024;
  std::array<T, kAtOnce> some;
  std::size_t below = 0;
  std::vector<T> between;
  for (std::size_t from = 0; from < values.size(); from += kAtOnce) {
    const std::size_t end = std::min(values.size(), from + kAtOnce);
    std::size_t kept = 0;
    for (std::size_t i = from; i < end; ++i) {
      const T value = values[i];
      const auto is_below = static_cast<std::size_t>(value < least);
      some[kept] = value;
      below += is_below;
      kept += (1 - is_below) & static_cast<std::size_t>(!(most < value));
    }
    between.insert(between.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  if (n < below || n - below >= between.size()) return {};
  const auto place = between.begin() + static_cast<std::ptrdiff_t>(n - below);
  std::nth_element(between.begin(), place, between.end());
  return *place;
}

/// The value at place n of the sorted ones, 0 the smallest. May reorder them.
template <class T>
[[nodiscard]] T nth_smallest(std::vector<T>& values, std::size_t n) {
  TRUEFLANK_EXPECTS(n < values.size());
  constexpr std::size_t kMany = 4096;
  if (values.size() >= kMany)
    if (const std::optional<T> found = nth_within_bounds(values, n)) return *found;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The value below which this share of all lies, 0 ... 1; there must be one.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  return nth_smallest(values,
                      static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// The middle value, of an even number the upper of the two; there must be one. May reorder them.
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

/// The step in which values were read, the smallest difference between them that is not rounding:
/// of fine ones next to nothing. Requires: some values.
[[nodiscard]] inline double step_of_readings(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double same = 1e-6 * (values.back() - values.front());
  double step = values.back() - values.front();
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] - values[k - 1] > same) step = std::min(step, values[k] - values[k - 1]);
  return step;
}

}  // namespace trueflank::loop
