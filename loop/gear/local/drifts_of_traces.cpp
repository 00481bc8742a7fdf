// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/drifts_of_traces.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/drift_of_traces.h"
#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {
namespace {

/// The mean of a flank's traces.
struct TracedHeight {
  int tooth = 0;
  int side = 0;
  bool left = false;
  double um = 0.0;
};

/// The heights of profile or of helix traces on one zero, by tooth; none where other records stand
/// beside them.
std::vector<TracedHeight> traced_heights(const FlankGeometry& geometry, const Observations& table,
                                         const std::vector<float>& row_um) {
  std::map<std::pair<int, int>, std::pair<double, double>> sums;
  std::optional<ObservationKind> kind;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const Observation& row = table.rows[r];
    if (row.kind == ObservationKind::kSize) continue;
    const bool traced =
        row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
    if (!traced || row.trace >= 0 || kind.value_or(row.kind) != row.kind) return {};
    kind = row.kind;
    const Place& place = table.place(row);
    if (place.surface != Surface::kFlank || !std::isfinite(row_um[r])) continue;
    auto& [sum, count] = sums[{place.tooth, place.side}];
    sum += static_cast<double>(row_um[r]);
    count += 1.0;
  }
  std::vector<TracedHeight> heights;
  for (const auto& [flank, of_flank] : sums)
    heights.push_back({flank.first, flank.second,
                       flank_choice(geometry, flank.second > 0 ? 1 : 0) == FlankChoice::kLeft,
                       of_flank.first / of_flank.second});
  return heights;
}

Eigen::VectorXd values_of_heights(const std::vector<TracedHeight>& heights) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(heights.size()));
  for (std::size_t i = 0; i < heights.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = heights[i].um;
  return values;
}

double square_left(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return (values - columns * columns.colPivHouseholderQr().solve(values)).squaredNorm();
}

/// What a wave once or twice a turn leaves, alike on both flanks or opposite on them, beside a mean
/// of either flank; and its columns.
double left_by_waves(const FlankGeometry& geometry, const std::vector<TracedHeight>& heights,
                     const Eigen::VectorXd& values) {
  double least = values.squaredNorm();
  for (const double order : {1.0, 2.0})
    for (const bool opposite : {false, true}) {
      Eigen::MatrixXd columns(values.size(), 4);
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        const TracedHeight& height = heights[static_cast<std::size_t>(i)];
        const double angle = kTwoPi * order * (height.tooth - 1) / geometry.teeth(),
                     sign = opposite ? height.side : 1.0;
        columns.row(i) << sign * std::cos(angle), sign * std::sin(angle), height.left ? 1.0 : 0.0,
            height.left ? 0.0 : 1.0;
      }
      least = std::min(least, square_left(columns, values));
    }
  return least;
}

/// Shares of a drift on each of the heights.
Eigen::VectorXd shares_of_drift(const std::vector<TracedHeight>& heights,
                                const std::vector<int>& teeth, int flanks, double within) {
  Eigen::VectorXd shares(static_cast<Eigen::Index>(heights.size()));
  const auto count = static_cast<double>(teeth.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const auto at = std::find(teeth.begin(), teeth.end(), heights[i].tooth) - teeth.begin();
    shares[static_cast<Eigen::Index>(i)] = gear_effects::drift_at_trace(
        gear_effects::trace_in_turn(flanks, static_cast<double>(at), count, heights[i].left),
        gear_effects::traces_in_turn(flanks, count), within);
  }
  return shares;
}

double left_beside_mean(const Eigen::VectorXd& shares, const Eigen::VectorXd& values) {
  Eigen::MatrixXd columns(values.size(), 2);
  columns << shares, Eigen::VectorXd::Ones(values.size());
  return square_left(columns, values);
}

double left_by_even_turn(const FlankGeometry& geometry, const std::vector<TracedHeight>& heights,
                         double first, const Eigen::VectorXd& values) {
  Eigen::VectorXd shares(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    shares[i] =
        gear_effects::teeth_since(geometry, heights[static_cast<std::size_t>(i)].tooth, first) /
        (geometry.teeth() - 1.0);
  return left_beside_mean(shares, values);
}

}  // namespace

std::optional<DriftOfTraces> drift_of_traces(const FlankGeometry& geometry,
                                             const Observations& table,
                                             const std::vector<float>& row_um) {
  constexpr std::size_t kFewestTeeth = 5;
  constexpr double kLevel = 1e-5, kMostLeft = 0.08, kOfWaves = 0.5, kClearlyUneven = 0.4;
  const std::vector<TracedHeight> heights = traced_heights(geometry, table, row_um);
  std::vector<int> teeth;
  bool left = false, right = false;
  for (const TracedHeight& height : heights) {
    if (teeth.empty() || teeth.back() != height.tooth) teeth.push_back(height.tooth);
    (height.left ? left : right) = true;
  }
  if (teeth.size() < kFewestTeeth) return std::nullopt;
  const Eigen::VectorXd values = values_of_heights(heights);
  const double all = (values.array() - values.mean()).square().sum();
  struct Likeliest {
    double left = 1e300, within = 0.0;
    int flanks = 0;
    std::vector<int> teeth;
  } best;
  int asked = 0;
  for (std::size_t first = 0; first < teeth.size(); ++first) {
    for (int flanks = 0; flanks < (left && right ? gear_effects::kFlankOrders : 1); ++flanks)
      for (const double within : {0.0, 0.2, 0.35, 0.6}) {
        ++asked;
        const double rest =
            left_beside_mean(shares_of_drift(heights, teeth, flanks, within), values);
        const bool more = best.teeth == teeth && best.flanks == flanks && best.within == 0.0;
        if (rest >= (more ? kClearlyUneven : 1.0) * best.left) continue;
        best = {rest, within, flanks, teeth};
      }
    std::rotate(teeth.begin(), teeth.begin() + 1, teeth.end());
  }
  const double free = static_cast<double>(heights.size()) - 3.0;
  DriftOfTraces found{.left = best.left, .heights = static_cast<double>(heights.size())};
  found.p_value = std::min(1.0, asked * f_tail((all - best.left) / (best.left / free), 1.0, free));
  if (found.p_value > kLevel || best.left > kMostLeft * all ||
      best.left > kOfWaves * left_by_waves(geometry, heights, values))
    return std::nullopt;
  found.left_by_turn = left_by_even_turn(geometry, heights, best.teeth.front(), values);
  // Nothing where it leaves least: on the first trace, where that says nearly as much.
  const Eigen::VectorXd shares = shares_of_drift(heights, best.teeth, best.flanks, best.within);
  double least = 1e300, zero_at = 0.0;
  for (const double zero :
       {gear_effects::kFirstOfDrift, gear_effects::kLastOfDrift, gear_effects::kMeanOfDrift}) {
    const double off = zero == gear_effects::kFirstOfDrift  ? 0.0
                       : zero == gear_effects::kLastOfDrift ? 1.0
                                                            : shares.mean();
    const Eigen::VectorXd about = shares.array() - off;
    const double rest = square_left(about, values);
    if (rest >= 0.8 * least) continue;
    least = rest;
    zero_at = zero;
    found.amount_um = about.dot(values) / about.squaredNorm();
  }
  found.shape = {double(best.flanks), best.within, zero_at};
  for (const int tooth : best.teeth) found.shape.push_back(tooth);
  return found;
}

}  // namespace trueflank::loop
