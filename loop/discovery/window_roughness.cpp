// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/window_roughness.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double likeness_of_neighbours(const MatrixXd& set) {
  const Index m = set.rows();
  std::vector<double> steps, values(set.data(), set.data() + set.size());
  for (Index c = 0; c < set.cols(); ++c)
    for (Index i = 1; i < m; ++i) steps.push_back(set(i, c) - set(i - 1, c));
  const double spread = robust_sigma(std::move(values)), step = robust_sigma(std::move(steps));
  return spread > 0.0 ? 1.0 - 0.5 * step * step / (spread * spread) : 1.0;
}

Roughness roughness_of(const MatrixXd& set) {
  const Index m = set.rows();
  Roughness rough{MatrixXd::Zero(m, set.cols()), {}};
  rough.squares.middleRows(1, m - 2) =
      (set.topRows(m - 2) - 2.0 * set.middleRows(1, m - 2) + set.bottomRows(m - 2)).cwiseAbs2() /
      6.0;
  for (Index c = 0; c < set.cols(); ++c) rough.usual.push_back(short_wave_scatter(set.col(c)));
  return rough;
}

MatrixXd roughness_in_windows(const Roughness& of, Index width) {
  const Index m = of.squares.rows();
  MatrixXd rough = MatrixXd::Ones(m - width + 1, of.squares.cols());
  for (Index c = 0; c < rough.cols(); ++c) {
    const double usual = of.usual[static_cast<std::size_t>(c)];
    if (!(usual > 0.0)) continue;
    for (Index i = 0; i + width <= m; ++i) {
      const Index from = std::max<Index>(1, i - 1), to = std::min(m - 1, i + width + 1);
      rough(i, c) =
          std::max(1.0, std::sqrt(of.squares.col(c).segment(from, to - from).mean()) / usual);
    }
  }
  return rough;
}

}  // namespace trueflank::loop
