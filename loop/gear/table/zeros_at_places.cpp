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

using Trace = std::vector<double>;  // values, in the order of the file

/// What a slope has no part in: second differences, each as loud as one value.
void add_second_differences(const Trace& trace, std::vector<double>& differences) {
  const double variance = 6.0;  // of a second difference, in those of a value
  for (std::size_t i = 2; i < trace.size(); ++i)
    differences.push_back((trace[i] - 2.0 * trace[i - 1] + trace[i - 2]) / std::sqrt(variance));
}

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
  std::map<SideAndTooth, std::map<long long, Trace>> flanks;
  std::set<long long> places;
  for (const InspectionRow& row : data.rows) {
    if (row.record != kind) continue;
    const double across = kind == RecordKind::kProfile ? row.z_mm : row.diameter_mm;
    if (!std::isfinite(across) || !std::isfinite(row.deviation_um)) continue;
    const long long place = std::llround(1000.0 * across);
    places.insert(place);
    flanks[{static_cast<int>(row.flank), row.tooth}][place].push_back(row.deviation_um);
  }
  std::erase_if(flanks, [&](const auto& flank) { return flank.second.size() != places.size(); });
  const std::size_t n = places.size();
  const bool has_slope = n > 2;
  if (n < 2 || flanks.size() < (has_slope ? kFewestFlanks : kFewestOfTwo)) return std::nullopt;

  // Middles of traces (a wild value is none), places in their order; less the mean of each side.
  std::map<int, std::vector<double>> of_side;  // at every place
  std::map<int, int> count;
  std::map<SideAndTooth, std::vector<double>> middles;
  std::vector<double> differences;
  double values = 0.0;
  for (auto& [flank, at] : flanks) {
    std::vector<double>& sums = of_side[flank.first];
    sums.resize(n);
    ++count[flank.first];
    std::size_t k = 0;
    for (auto& [place, trace] : at) {
      add_second_differences(trace, differences);
      values += static_cast<double>(trace.size());
      middles[flank].push_back(median(trace));
      sums[k++] += middles[flank].back();
    }
  }
  if (differences.empty()) return std::nullopt;
  const double traces = static_cast<double>(n * flanks.size());
  const double noise_um = robust_sigma(differences) / std::sqrt(values / traces);

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
    for (const auto& [flank, of_flank] : middles) {
      if (flank.first != side) continue;
      Eigen::VectorXd means(static_cast<Eigen::Index>(n));
      for (std::size_t k = 0; k < n; ++k) {
        means[static_cast<Eigen::Index>(k)] = of_flank[k] - sums[k] / count[side];
        all.push_back(means[static_cast<Eigen::Index>(k)]);
      }
      const Eigen::VectorXd rest = means - own * solver.solve(means);
      for (std::size_t k = 0; k < n; ++k)
        rests[k].push_back(rest[static_cast<Eigen::Index>(k)] / kept);
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
