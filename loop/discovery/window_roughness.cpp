// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/window_roughness.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

Loudness loudness_of_few(const std::vector<double>& scatters, const std::vector<double>& values) {
  constexpr std::size_t kEnough = 5;
  std::vector<std::pair<double, double>> known;
  for (std::size_t i = 0; i < scatters.size(); ++i)
    if (scatters[i] > 0.0) known.emplace_back(scatters[i], values[i]);
  if (known.size() < 2 || known.size() >= kEnough) return loudness_of(scatters, values);
  std::sort(known.begin(), known.end());
  const auto [usual, count] = known[(known.size() - 1) / 2];
  std::vector<double> filled = scatters, of_filled = values;
  filled.resize(scatters.size() + kEnough - known.size(), usual);
  of_filled.resize(filled.size(), count);
  Loudness loud = loudness_of(filled, of_filled);
  loud.factors.resize(scatters.size());
  for (double& factor : loud.factors) factor = std::max(1.0, factor);
  return loud;
}

VectorXd loudness_of_places(const std::vector<MatrixXd>& sets,
                            const std::vector<std::vector<double>>& scatters) {
  constexpr Index kParts = 12;
  constexpr std::size_t kFewestInAPart = 12;
  const Index m = sets.front().rows();
  std::vector<std::vector<double>> bends(kParts);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (Index c = 0; c < sets[s].cols(); ++c) {
      const double usual = scatters[s][static_cast<std::size_t>(c)];
      if (!(usual > 0.0)) continue;
      const auto course = sets[s].col(c);
      for (Index i = 1; i + 1 < m; ++i)
        bends[static_cast<std::size_t>(kParts * i / m)].push_back(
            (course[i - 1] - 2.0 * course[i] + course[i + 1]) / usual);
    }
  std::vector<double> of_parts, values;
  for (std::vector<double>& of_part : bends) {
    values.push_back(static_cast<double>(of_part.size()));
    of_parts.push_back(of_part.size() < kFewestInAPart ? 0.0 : robust_sigma(std::move(of_part)));
  }
  const std::vector<double> factors = loudness_of(of_parts, values).factors;
  VectorXd loud(m);
  for (Index i = 0; i < m; ++i) {  // straight from the middle of a part to that of the next
    const double at = std::clamp(
        (static_cast<double>(i) + 0.5) * kParts / static_cast<double>(m) - 0.5, 0.0, kParts - 1.0);
    const auto before = std::min<std::size_t>(static_cast<std::size_t>(at), kParts - 2);
    const double part = at - static_cast<double>(before);
    loud[i] = std::max(1.0, (1.0 - part) * factors[before] + part * factors[before + 1]);
  }
  return loud;
}

}  // namespace trueflank::loop
