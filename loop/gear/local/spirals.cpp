// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/spirals.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

constexpr int kDirections = 360, kCells = 2 * kDirections;  // of either side
using AllCells = Eigen::Matrix<double, kCells, 1>;

/// Means towards so many directions, of the flanks of either side, of how far a unit would move a
/// wall: roots of the weights, and values times these.
struct MeansAround {
  AllCells root = AllCells::Zero(), value = AllCells::Zero();
};

/// Waves of both sides, after a level of each side and a wave once a turn that is opposite on them,
/// as of a gear off its axis: columns at right angles to each other, with the roots of the weights
/// on.
Eigen::MatrixXd waves(const MeansAround& means, int orders) {
  constexpr int kOpposite = 3;
  Eigen::MatrixXd columns(kCells, 1 + kOpposite + 2 * orders);
  for (int k = 0; k < kCells; ++k) {
    const double angle = kTwoPi * (k % kDirections + 0.5) / kDirections,
                 side = k < kDirections ? -1.0 : 1.0;
    const std::array<double, 4> first{1.0, side, side * std::cos(angle), side * std::sin(angle)};
    for (int c = 0; c < 4; ++c) columns(k, c) = means.root[k] * first[static_cast<std::size_t>(c)];
    for (int order = 1; order <= orders; ++order) {
      columns(k, 2 + 2 * order) = means.root[k] * std::cos(order * angle);
      columns(k, 3 + 2 * order) = means.root[k] * std::sin(order * angle);
    }
  }
  return orthonormal_columns(columns);
}

struct Best {
  int from = 0;
  double gain = 0.0;
};

/// Where a drift takes out most of the values beside these columns.
Best likeliest(const MeansAround& means, const Eigen::MatrixXd& beside, const AllCells& left) {
  Best best;
  AllCells drift;
  for (int from = 0; from < kDirections; ++from) {
    for (int k = 0; k < kDirections; ++k)
      drift[(from + k) % kDirections] = (k + 0.5) / kDirections - 0.5;
    drift.tail<kDirections>() = drift.head<kDirections>();
    drift.array() *= means.root.array();
    const double square = drift.squaredNorm() - (beside.transpose() * drift).squaredNorm(),
                 product = drift.dot(left);
    if (square > 0.0 && product * product > best.gain * square)
      best = {from, product * product / square};
  }
  return best;
}

}  // namespace

std::optional<Spiral> spiral_around(const FlankGeometry& geometry, const Observations& table,
                                    const Patches& patches, const std::vector<float>& row_um) {
  constexpr int kBeside = 3, kInstead = 6, kMore = 2 * (kInstead - kBeside);  // waves a turn
  constexpr double kGain = 80.0, kClearly = 25.0, kPart = 0.35;  // chi-square, of the gain
  std::array<AllCells, 2> weights{AllCells::Zero(), AllCells::Zero()}, products = weights;
  AllCells counts = AllCells::Zero(), sums = counts;
  double squares = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const int patch = patches.patch_of_row[i];
    if (row.kind != ObservationKind::kScanFlank || row.places != 1 || patch < 0 ||
        patches.patches[static_cast<std::size_t>(patch)].fold == 0 || !std::isfinite(row_um[i]))
      continue;
    const Place& place = table.place(row);
    const double turns = place.polar_rad / kTwoPi;
    const int at =
        std::min(kDirections - 1, static_cast<int>((turns - std::floor(turns)) * kDirections)) +
        (place.side > 0 ? kDirections : 0);
    const double um = row_um[i], radius = normal_part(geometry, place, place.polar_direction[0],
                                                      place.polar_direction[1]);
    counts[at] += 1.0;
    sums[at] += um;
    weights[0][at] += 1.0;
    products[0][at] += um;
    weights[1][at] += radius * radius;
    products[1][at] += radius * um;
    squares += um * um;
  }
  constexpr double kFewestRows = 1000.0, kFewestDirections = 0.5;
  double within = squares, degrees = -1.0;
  int seen = 0;
  for (int k = 0; k < kCells; ++k) {
    if (!(counts[k] > 0.0)) continue;
    within -= sums[k] * sums[k] / counts[k];
    degrees += counts[k] - 1.0;
    ++seen;
  }
  if (!(counts.sum() > kFewestRows && degrees > 0.0 && within > 0.0) ||
      seen < kFewestDirections * kDirections)
    return {};
  const double sigma = std::sqrt(within / degrees);
  std::optional<Spiral> best;
  double most = 0.0;
  for (const bool outwards : {false, true}) {
    MeansAround means;
    const std::size_t of = outwards ? 1 : 0;
    means.root = weights[of].cwiseSqrt() / sigma;
    for (int k = 0; k < kCells; ++k)
      if (weights[of][k] > 0.0) means.value[k] = products[of][k] / (sigma * sigma) / means.root[k];
    const Eigen::MatrixXd all = waves(means, kInstead), beside = all.leftCols(all.cols() - kMore);
    const AllCells left = means.value - beside * (beside.transpose() * means.value);
    const double by_waves = (all.rightCols(kMore).transpose() * left).squaredNorm(),
                 around = left.squaredNorm() - seen;
    if (around < kGain) continue;
    const Best found = likeliest(means, beside, left);
    if (found.gain < kGain || found.gain < by_waves + kClearly ||
        around - found.gain > kPart * found.gain || found.gain < most)
      continue;
    most = found.gain;
    best = {360.0 * found.from / kDirections, std::max(1e-30, std::exp(-0.5 * found.gain)),
            outwards};
  }
  return best;
}

}  // namespace trueflank::loop
