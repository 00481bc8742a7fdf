// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/zeros_at_places.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// One trace so far: its mean, and the noise of its values from second differences, which a slope
/// has no part in.
struct TraceMean {
  int values = 0, differences = 0;
  double sum = 0.0, last = kNaN, before = kNaN, square = 0.0;
  void add(double um) {
    ++values;
    sum += um;
    if (!std::isnan(before)) {
      constexpr double kOfThree = 6.0;  // variance of a second difference
      square += std::pow(um - 2.0 * last + before, 2) / kOfThree;
      ++differences;
    }
    before = last;
    last = um;
  }
  [[nodiscard]] double mean() const { return sum / values; }
};

using SideAndTooth = std::pair<int, int>;

/// Waves of low orders around the teeth of one side are taken out.
void take_waves_out(std::vector<double>& values, const std::vector<int>& teeth) {
  constexpr int kMostWaves = 2;
  const Eigen::Index n = std::ssize(values);
  const int most = *std::max_element(teeth.begin(), teeth.end());
  Eigen::MatrixXd columns(n, 2 * kMostWaves + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns(i, 0) = 1.0;
    for (int k = 1; k <= kMostWaves; ++k) {
      const double angle = k * kTwoPi * teeth[static_cast<std::size_t>(i)] / most;
      columns(i, 2 * k - 1) = std::cos(angle);
      columns(i, 2 * k) = std::sin(angle);
    }
  }
  const Eigen::Map<Eigen::VectorXd> right(values.data(), n);
  const Eigen::VectorXd left = right - columns * columns.colPivHouseholderQr().solve(right);
  std::copy(left.begin(), left.end(), values.begin());
}

}  // namespace

std::optional<double> zeros_at_places_um(const InspectionData& data, RecordKind kind) {
  constexpr std::size_t kFewestFlanks = 6, kFewestOfTwo = 30;
  constexpr double kOfNoise = 6.0, kOfScatter = 0.35, kRough = 0.7;
  if (data.common_zero) return std::nullopt;
  std::map<SideAndTooth, std::map<long long, TraceMean>> flanks;
  std::set<long long> places;
  for (const InspectionRow& row : data.rows) {
    if (row.record != kind) continue;
    const double across = kind == RecordKind::kProfile ? row.z_mm : row.diameter_mm;
    if (!std::isfinite(across) || !std::isfinite(row.deviation_um)) continue;
    const long long place = std::llround(1000.0 * across);
    places.insert(place);
    flanks[{static_cast<int>(row.flank), row.tooth}][place].add(row.deviation_um);
  }
  std::erase_if(flanks, [&](const auto& flank) { return flank.second.size() != places.size(); });
  const std::size_t n = places.size();
  const bool has_slope = n > 2;
  if (n < 2 || flanks.size() < (has_slope ? kFewestFlanks : kFewestOfTwo)) return std::nullopt;

  // Means of flanks, places in their order; less the mean of each side there.
  std::map<int, std::vector<double>> of_side;  // at every place
  std::map<int, int> count;
  double noise_square = 0.0;
  int differences = 0, values = 0, traces = 0;
  for (const auto& [flank, at] : flanks) {
    std::vector<double>& sums = of_side[flank.first];
    sums.resize(n);
    ++count[flank.first];
    std::size_t k = 0;
    for (const auto& [place, trace] : at) {
      sums[k++] += trace.mean();
      noise_square += trace.square;
      differences += trace.differences;
      values += trace.values;
      ++traces;
    }
  }
  if (differences == 0) return std::nullopt;
  const double noise_um =
      std::sqrt(noise_square / differences / (static_cast<double>(values) / traces));

  Eigen::MatrixXd own(static_cast<Eigen::Index>(n), has_slope ? 2 : 1);
  {
    Eigen::Index k = 0;
    for (const long long place : places) {
      own(k, 0) = 1.0;
      if (has_slope) own(k, 1) = 1e-3 * static_cast<double>(place);
      ++k;
    }
  }
  const auto solver = own.colPivHouseholderQr();
  // (what a flank's own mean and slope leave is smaller than what was there)
  const double kept = std::sqrt(static_cast<double>(n - static_cast<std::size_t>(own.cols())) /
                                static_cast<double>(n));
  std::vector<double> all, left, steps;
  for (const auto& [side, sums] : of_side) {
    // At one place after the other, from tooth to tooth.
    std::vector<std::vector<double>> rests(n);
    std::vector<int> teeth;
    for (const auto& [flank, at] : flanks) {
      if (flank.first != side) continue;
      Eigen::VectorXd means(static_cast<Eigen::Index>(n));
      std::size_t k = 0;
      for (const auto& [place, trace] : at) {
        means[static_cast<Eigen::Index>(k)] = trace.mean() - sums[k] / count[side];
        all.push_back(means[static_cast<Eigen::Index>(k++)]);
      }
      const Eigen::VectorXd rest = means - own * solver.solve(means);
      for (k = 0; k < n; ++k) rests[k].push_back(rest[static_cast<Eigen::Index>(k)] / kept);
      teeth.push_back(flank.second);
    }
    for (std::vector<double>& rest : rests) {
      if (!has_slope && rest.size() >= kFewestFlanks) take_waves_out(rest, teeth);
      for (std::size_t i = 1; i < rest.size(); ++i)
        steps.push_back((rest[i] - rest[i - 1]) / std::sqrt(2.0));
      left.insert(left.end(), rest.begin(), rest.end());
    }
  }
  const double left_um = robust_sigma(left);
  const bool own_zeros = left_um > kOfNoise * noise_um &&
                         left_um > kOfScatter * robust_sigma(all) &&
                         robust_sigma(steps) > kRough * left_um;
  return own_zeros ? std::optional(left_um) : std::nullopt;
}

}  // namespace trueflank::loop
