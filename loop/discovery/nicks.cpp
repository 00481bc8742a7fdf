// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/nicks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {

std::optional<CourseFinding> nick_of(const std::vector<Eigen::MatrixXd>& apart,
                                     const std::vector<double>& alike) {
  // The tail of one value's chance, in degrees; what two more values add at most to the power of it
  // that is the chance of three; what is told must be sure.
  constexpr double kTail = 20.0, kMostAdded = 0.8, kTwice = 2.0, kSure = 0.01;
  CourseFinding best{CourseFinding::Kind::kSpot};
  double tests = 0.0;
  for (std::size_t s = 0; s < apart.size(); ++s) {
    const Eigen::MatrixXd& set = apart[s];
    // (of few courses a third or a fifth are what is usual, and nothing is left of them)
    std::vector<double> off;
    std::copy_if(set.data(), set.data() + set.size(), std::back_inserter(off),
                 [](double value) { return value != 0.0; });
    if (off.empty()) continue;
    const double spread = robust_sigma(std::move(off));
    if (!(spread > 0.0)) continue;
    const double shared = std::clamp(alike[s], 0.0, 1.0),
                 power = 1.0 + kMostAdded * (1.0 - shared * shared);
    const auto places = static_cast<double>(set.rows());
    tests += (places - 2.0) * static_cast<double>(set.cols());
    for (Eigen::Index c = 0; c < set.cols(); ++c)
      for (Eigen::Index i = 0; i + 3 <= set.rows(); ++i) {
        const auto three = set.col(c).segment(i, 3);
        const double nearest = three[0] > 0.0 ? three.minCoeff() : -three.maxCoeff();
        if (!(nearest > 0.0)) continue;
        const double p = std::pow(student_two_sided(nearest / spread, kTail), power);
        if (!(p < best.p_value)) continue;
        best.p_value = p;
        best.set = static_cast<int>(s);
        best.course = static_cast<int>(c);
        best.at = (static_cast<double>(i) + 1.5) / places;
        best.width = 3.0 / places;
        best.amount = three.mean();
        best.square = 3.0 * best.amount * best.amount;
      }
  }
  best.p_value *= kTwice * tests;
  if (!(best.set >= 0 && best.p_value < kSure)) return {};
  return best;
}

}  // namespace trueflank::loop
