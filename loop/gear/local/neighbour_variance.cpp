// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/neighbour_variance.h"

#include <algorithm>
#include <numeric>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {

std::vector<double> squares_beside_lines(std::vector<OnTrace> values) {
  std::sort(values.begin(), values.end(),
            [](const OnTrace& a, const OnTrace& b) { return a.at_mm < b.at_mm; });
  std::vector<double> squares;
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    const OnTrace &before = values[k - 1], &here = values[k], &after = values[k + 1];
    const double all = after.at_mm - before.at_mm;
    if (!(all > 0.0)) continue;
    const double share = (here.at_mm - before.at_mm) / all, rest = 1.0 - share;
    const double off = here.um - rest * before.um - share * after.um;
    squares.push_back(
        off * off /
        (here.loud_square + rest * rest * before.loud_square + share * share * after.loud_square));
  }
  return squares;
}

double robust_variance(std::vector<double>& squares) {
  if (squares.size() < 8)
    return squares.empty() ? 0.0
                           : std::accumulate(squares.begin(), squares.end(), 0.0) /
                                 static_cast<double>(squares.size());
  return median(squares) / kMedianOfSquare;
}

bool are_apart(const std::array<double, 2>& variance, const std::array<std::size_t, 2>& counts) {
  // A median tells as much as 0.37 of the squares, neighbours share two values of three.
  constexpr double kTold = 0.37 / 2.0, kSure = 1e-4;
  constexpr std::size_t kFewest = 40;
  if (std::min(counts[0], counts[1]) < kFewest || !(variance[0] > 0.0 && variance[1] > 0.0))
    return false;
  const std::size_t larger = variance[1] > variance[0] ? 1 : 0;
  return f_tail(variance[larger] / variance[1 - larger],
                kTold * static_cast<double>(counts[larger]),
                kTold * static_cast<double>(counts[1 - larger])) < kSure;
}

}  // namespace trueflank::loop
