// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/bench_table.h"
#include "trueflank/loop/drive/bench_visits.h"

// Whether the error of a bench's rows grows with the load or the speed.
namespace trueflank::loop {
namespace {

constexpr double kMeanOfSize = 0.7978845608;  // of |x| where x is normal, in standard deviations
constexpr double kMostSize = 4.0;             // beyond, a row is a slip
constexpr double kSureGrowth = 4.5;           // standard errors: benches of even noise are many
constexpr double kLeastGrowth = 1.7;          // from one end of the range to the other
constexpr double kLeastOfMiddle = 0.2;        // no row weighs more than 25 of the middle
constexpr std::size_t kFewestToGrow = 60;

/// How far every row is off, in its direction's noise: from the others of its set point, where this
/// comes again, so that what the smooth fit does not follow is no noise.
std::vector<double> sizes_of(const std::vector<BenchPoint>& points, const SmoothFit& fit) {
  std::vector<double> size(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    size[i] =
        fit.residual_nm[i] / (points[i].forward ? fit.sigma_forward_nm : fit.sigma_backward_nm);
  std::map<int, std::vector<std::size_t>> members;
  const std::vector<int> set_point = set_points_of(points);
  for (std::size_t i = 0; i < points.size(); ++i) members[set_point[i]].push_back(i);
  std::size_t again = 0;
  for (const auto& [number, rows] : members) again += rows.size() > 1 ? rows.size() : 0;
  if (2 * again >= points.size())
    for (const auto& [number, rows] : members) {
      if (rows.size() < 2) continue;
      double mean = 0.0;
      const auto n = static_cast<double>(rows.size());
      for (const std::size_t i : rows) mean += size[i] / n;
      for (const std::size_t i : rows) size[i] = (size[i] - mean) * std::sqrt(n / (n - 1.0));
    }
  for (double& s : size) s = std::min(std::abs(s), kMostSize);
  return size;
}

}  // namespace

std::vector<double> growth_of_noise(const std::vector<BenchPoint>& points, const SmoothFit& fit) {
  std::vector<double> growth(points.size(), 1.0);
  if (points.size() < kFewestToGrow) return growth;
  const std::vector<double> size = sizes_of(points, fit);
  double load = 1e-300, speed = 1e-300;
  for (const BenchPoint& p : points) {
    load = std::max(load, p.load_nm);
    speed = std::max(speed, p.speed_rpm);
  }
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd all(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BenchPoint& p = points[static_cast<std::size_t>(i)];
    all.row(i) << 1.0, p.load_nm / load, p.speed_rpm / speed;
    y[i] = size[static_cast<std::size_t>(i)] / kMeanOfSize;
  }
  std::vector<Eigen::Index> kept{0, 1, 2};
  // What is not sure goes, the least sure first. (|x| scatters in proportion to its mean.)
  while (kept.size() > 1) {
    const Eigen::MatrixXd x = all(Eigen::all, kept);
    Eigen::VectorXd expected = Eigen::VectorXd::Constant(n, std::max(y.mean(), 1e-300)), b;
    Eigen::MatrixXd gram;
    for (int round = 0; round < 6; ++round) {
      const Eigen::VectorXd w = expected.cwiseAbs2().cwiseInverse();
      gram = x.transpose() * w.asDiagonal() * x;
      gram.diagonal().array() += 1e-12 * gram.diagonal().maxCoeff();
      b = symmetric_solution(gram, x.transpose() * w.asDiagonal() * y);
      expected = (x * b).cwiseMax(kLeastOfMiddle * y.mean());
    }
    const double scatter = std::sqrt(kPi / 2.0 - 1.0);  // of |x| / its mean
    std::size_t least = 0;
    double least_sure = 1e300;
    for (std::size_t k = 1; k < kept.size(); ++k) {
      Eigen::VectorXd one = Eigen::VectorXd::Zero(b.size());
      one[static_cast<Eigen::Index>(k)] = 1.0;
      const double error =
          scatter *
          std::sqrt(std::max(1e-300, symmetric_solution(gram, one)[static_cast<Eigen::Index>(k)]));
      const double slope = b[static_cast<Eigen::Index>(k)], low = all.col(kept[k]).minCoeff(),
                   high = all.col(kept[k]).maxCoeff();
      // Along this one alone, the others at their middle.
      double middle = 0.0;
      for (std::size_t j = 0; j < kept.size(); ++j)
        if (j != k) middle += b[static_cast<Eigen::Index>(j)] * all.col(kept[j]).mean();
      const double at_low = std::max(middle + slope * low, kLeastOfMiddle * y.mean()),
                   at_high = std::max(middle + slope * high, kLeastOfMiddle * y.mean());
      const bool grows = std::max(at_low, at_high) > kLeastGrowth * std::min(at_low, at_high);
      const double sure = grows ? std::abs(slope) / error : 0.0;
      if (sure >= least_sure) continue;
      least_sure = sure;
      least = k;
    }
    if (least_sure > kSureGrowth) {
      for (std::size_t i = 0; i < points.size(); ++i)
        growth[i] = expected[static_cast<Eigen::Index>(i)];
      return growth;
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return growth;
}

}  // namespace trueflank::loop
