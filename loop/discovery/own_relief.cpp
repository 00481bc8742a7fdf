// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/own_relief.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A set less what its courses have in common, but those that lie far off: these would show in all.
MatrixXd without_common(const MatrixXd& set) {
  constexpr double kFar = 10.0;
  std::vector<double> squares;
  for (Index c = 0; c < set.cols(); ++c)
    squares.push_back((set.col(c).array() - set.col(c).mean()).square().sum());
  const double most = kFar * median(squares);
  VectorXd sum = VectorXd::Zero(set.rows());
  double count = 0.0;
  for (Index c = 0; c < set.cols(); ++c)
    if (squares[static_cast<std::size_t>(c)] <= most) {
      sum += set.col(c);
      count += 1.0;
    }
  return set.colwise() - sum / std::max(1.0, count);
}

/// Part of all waves, from the longest: from one share of them to another.
struct Part {
  double from = 0.0, to = 0.0;
};
double mean_of(const VectorXd& level, const Part& part) {
  const auto n = static_cast<double>(level.size());
  const auto first = static_cast<Index>(part.from * n);
  const auto end = std::max(first + 1, static_cast<Index>(part.to * n));
  return level.segment(first, end - first).mean();
}

}  // namespace

VectorXd cosine_spectrum(const VectorXd& course) {
  const Index n = course.size();
  VectorXd result(n);
  const double step = kPi / static_cast<double>(n);
  for (Index k = 0; k < n; ++k) {
    double sum = 0.0;
    for (Index i = 0; i < n; ++i)
      sum += course[i] * std::cos(step * static_cast<double>(k) * (static_cast<double>(i) + 0.5));
    result[k] = sum * sum * (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
  }
  return result;
}

std::optional<OwnRelief> own_relief(const std::vector<MatrixXd>& sets) {
  constexpr Index kFewestRows = 32, kFewestInASet = 3;
  constexpr double kToldByMedian = 0.37;
  // The longest waves are lines and bows, which have a test of their own.
  constexpr Part kLong{0.0, 0.11}, kBeyond{0.13, 0.2}, kErrors{0.25, 1.0};
  constexpr Part kLonger{0.25, 0.4}, kShorter{0.4, 0.65}, kShortest{0.65, 1.0};
  constexpr Index kFirst = 2, kFewestWaves = 3;
  constexpr double kClearly = 12.0, kBeyondTrends = 6.0, kEnds = 0.25;
  constexpr double kEven = 1.7, kEvenBesideShortest = 1.5, kStillErrors = 3.0;
  if (sets.empty() || sets.front().rows() < kFewestRows) return {};
  const Index waves = sets.front().rows() - 1;
  double courses = 0.0;
  std::vector<std::vector<double>> squares(static_cast<std::size_t>(waves));
  VectorXd sum = VectorXd::Zero(waves);
  for (const MatrixXd& set : sets) {
    if (set.cols() < kFewestInASet) continue;
    const auto count = static_cast<double>(set.cols());
    courses += count - 1.0;
    const MatrixXd own = without_common(set);
    for (Index c = 0; c < set.cols(); ++c) {
      const VectorXd parts = cosine_spectrum(own.col(c)).tail(waves);
      sum += parts;
      for (Index k = 0; k < waves; ++k)
        squares[static_cast<std::size_t>(k)].push_back(parts[k] * count / (count - 1.0));
    }
  }
  if (!(courses > 0.0)) return {};
  VectorXd level(waves);
  for (Index k = 0; k < waves; ++k)
    level[k] = median(std::move(squares[static_cast<std::size_t>(k)])) / kMedianOfSquare;
  const double of_long = mean_of(level, kLong), error = mean_of(level, kErrors),
               shortest = mean_of(level, kShortest);
  const auto longest = static_cast<Index>(kLong.to * static_cast<double>(waves));
  const double without_trends =
      level.segment(kFirst, std::max(kFewestWaves, longest - kFirst)).mean();
  if (!(shortest > 0.0) || of_long < kClearly * error || without_trends < kBeyondTrends * error ||
      mean_of(level, kBeyond) > kEnds * of_long || mean_of(level, kLonger) > kEven * shortest ||
      mean_of(level, kShorter) > kEvenBesideShortest * shortest)
    return {};
  OwnRelief found;
  const double degrees = kToldByMedian * courses * kLong.to * static_cast<double>(waves);
  found.p_value = f_tail(of_long / (kStillErrors * error), degrees, degrees);
  const auto end = static_cast<Index>(kErrors.from * static_cast<double>(waves));
  // From the largest on, as far as they stand out.
  Index shortest_wave = 0;
  level.head(end).maxCoeff(&shortest_wave);
  while (shortest_wave + 1 < end && level[shortest_wave + 1] > kStillErrors * error)
    ++shortest_wave;
  found.waves = 0.5 * static_cast<double>(shortest_wave + 1);
  const double square = sum.head(end).sum() / courses - error * static_cast<double>(end);
  found.spread = std::sqrt(std::max(0.0, square) / static_cast<double>(waves + 1));
  return found;
}

}  // namespace trueflank::loop
