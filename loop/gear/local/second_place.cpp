// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/second_place.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "trueflank/loop/discovery/mixed_bits.h"

namespace trueflank::loop {
namespace {

/// A value that was left of a point, and its normal in the plane.
struct LeftOfPoint {
  Eigen::Vector2d normal;
  double um = 0.0;
  std::size_t row = 0;
};

/// `take(point)` for every n-th row that is one of a scanned flank.
template <class Take>
void for_points(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                const std::vector<float>& row_um, std::size_t stride, const Take& take) {
  for (std::size_t i = 0; i < table.points_mm.size(); i += stride) {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank || patches.patch_of_row[i] < 0 ||
        !std::isfinite(row_um[i]))
      continue;
    const Place& place = table.place(row);
    take(LeftOfPoint{
        {normal_part(geometry, place, 1.0, 0.0), normal_part(geometry, place, 0.0, 1.0)},
        row_um[i],
        i});
  }
}

double minus_log_density(double off, double square) {
  return 0.5 * (off * off / square + std::log(square));
}

/// Noise whose square goes with the direction of the wall: by n' S n, S a matrix.
struct NoiseByDirection {
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  double minus_log = 0.0;  ///< of the likelihood of all points

  [[nodiscard]] double at(const LeftOfPoint& p) const { return p.normal.dot(square * p.normal); }
};

NoiseByDirection noise_by_direction(std::span<const LeftOfPoint> points) {
  constexpr int kTurns = 6;
  constexpr double kLeast = 0.02;  // of the mean square
  double mean = 0.0;
  for (const LeftOfPoint& p : points) mean += p.um * p.um;
  mean /= static_cast<double>(points.size());
  NoiseByDirection noise;
  noise.square = mean * Eigen::Matrix2d::Identity();
  const auto square_at = [&](const LeftOfPoint& p) { return std::max(kLeast * mean, noise.at(p)); };
  for (int turn = 0; turn < kTurns; ++turn) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const LeftOfPoint& p : points) {
      const Eigen::Vector3d by(p.normal[0] * p.normal[0], p.normal[1] * p.normal[1],
                               2.0 * p.normal[0] * p.normal[1]);
      const double weight = 1.0 / (square_at(p) * square_at(p));
      normal += weight * by * by.transpose();
      right += weight * p.um * p.um * by;
    }
    const Eigen::Vector3d found = normal.fullPivLu().solve(right);
    noise.square << found[0], found[2], found[2], found[1];
  }
  for (const LeftOfPoint& p : points) noise.minus_log += minus_log_density(p.um, square_at(p));
  return noise;
}

/// Two places, each with its share of the points, and a noise that is the same everywhere.
struct TwoPlaces {
  std::array<Eigen::Vector2d, 2> at_um{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double share = 0.5;  ///< of the first
  double square = 0.0;
  double minus_log = 0.0;

  /// How likely a point is of the first, and what it adds to minus_log.
  [[nodiscard]] std::pair<double, double> of_first(const LeftOfPoint& p) const {
    const double first = minus_log_density(p.um - p.normal.dot(at_um[0]), square) - std::log(share),
                 other =
                     minus_log_density(p.um - p.normal.dot(at_um[1]), square) - std::log1p(-share);
    const double least = std::min(first, other);
    const double sum = std::exp(least - first) + std::exp(least - other);
    return {std::exp(least - first) / sum, least - std::log(sum)};
  }
};

TwoPlaces two_places(std::span<const LeftOfPoint> points, const NoiseByDirection& noise) {
  constexpr int kTurns = 60;
  constexpr double kLeastShare = 0.02;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(noise.square);
  TwoPlaces two;
  two.square = std::max(1e-12, axes.eigenvalues()[0]);
  const double apart = std::sqrt(std::max(0.0, axes.eigenvalues()[1] - axes.eigenvalues()[0]));
  two.at_um = {apart * axes.eigenvectors().col(1), -apart * axes.eigenvectors().col(1)};
  for (int turn = 0; turn <= kTurns; ++turn) {
    std::array<Eigen::Matrix2d, 2> normal{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
    std::array<Eigen::Vector2d, 2> right{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    double first = 0.0, square = 0.0;
    two.minus_log = 0.0;
    for (const LeftOfPoint& p : points) {
      const auto [of_first, minus_log] = two.of_first(p);
      two.minus_log += minus_log;
      first += of_first;
      for (const std::size_t k : {0U, 1U}) {
        const double of = k == 0 ? of_first : 1.0 - of_first,
                     off = p.um - p.normal.dot(two.at_um[k]);
        normal[k] += of * p.normal * p.normal.transpose();
        right[k] += of * p.um * p.normal;
        square += of * off * off;
      }
    }
    if (turn == kTurns) break;
    const auto count = static_cast<double>(points.size());
    two.share = std::clamp(first / count, kLeastShare, 1.0 - kLeastShare);
    two.square = std::max(1e-12, square / count);
    for (const std::size_t k : {0U, 1U}) two.at_um[k] = normal[k].fullPivLu().solve(right[k]);
  }
  return two;
}

/// True where points of the first place lie at random among the others: of neighbours on a flank,
/// by height and by roll length, no more are of one place than chance makes.
bool lie_at_random(const Observations& table, std::span<const LeftOfPoint> points,
                   const TwoPlaces& two) {
  constexpr double kClear = 3.0, kMore = 0.1, kFewest = 100.0;
  struct Clear {
    int flank;
    double roll_mm, z_mm;
    bool first;
  };
  const Eigen::Vector2d apart = two.at_um[0] - two.at_um[1];
  std::vector<Clear> clear;
  double of_first = 0.0;
  for (const LeftOfPoint& p : points) {
    if (std::abs(p.normal.dot(apart)) < kClear * std::sqrt(two.square)) continue;
    const Place& place = table.place(table.rows[p.row]);
    clear.push_back({2 * place.tooth + (place.side > 0 ? 1 : 0), place.roll_mm, place.z_mm,
                     two.of_first(p).first > 0.5});
    of_first += clear.back().first ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(clear.size());
  if (count < kFewest) return false;
  const double share = of_first / count, by_chance = share * share + (1.0 - share) * (1.0 - share);
  for (const double Clear::*along : {&Clear::z_mm, &Clear::roll_mm}) {
    const double Clear::*across = along == &Clear::z_mm ? &Clear::roll_mm : &Clear::z_mm;
    std::sort(clear.begin(), clear.end(), [&](const Clear& a, const Clear& b) {
      return a.flank != b.flank     ? a.flank < b.flank
             : a.*along != b.*along ? a.*along < b.*along
                                    : a.*across < b.*across;
    });
    double pairs = 0.0, alike = 0.0;
    for (std::size_t i = 1; i < clear.size(); ++i) {
      if (clear[i].flank != clear[i - 1].flank) continue;
      pairs += 1.0;
      alike += clear[i].first == clear[i - 1].first ? 1.0 : 0.0;
    }
    if (!(alike < (by_chance + kMore) * pairs)) return false;
  }
  return true;
}

}  // namespace

std::optional<SecondPlace> second_place(const FlankGeometry& geometry, const Observations& table,
                                        const Patches& patches, const std::vector<float>& row_um) {
  constexpr std::size_t kFewest = 200, kSample = 20'000;
  constexpr double kSquareBeyond = 0.8;                                    // of the noise's
  constexpr double kLeastShare = 0.15, kApart = 2.0, kBeyondDoubt = 50.0,  // log of likelihood
      kSurest = 1e-12;
  std::vector<LeftOfPoint> some;
  const std::size_t stride = 1 + table.points_mm.size() / kSample;
  for_points(geometry, table, patches, row_um, stride,
             [&](const LeftOfPoint& p) { some.push_back(p); });
  if (some.size() < kFewest) return {};
  const NoiseByDirection noise = noise_by_direction(some);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(noise.square);
  if (!(axes.eigenvalues()[1] > (1.0 + kSquareBeyond) * axes.eigenvalues()[0])) return {};
  const TwoPlaces two = two_places(some, noise);
  if (two.share < kLeastShare || two.share > 1.0 - kLeastShare ||
      (two.at_um[0] - two.at_um[1]).norm() < kApart * std::sqrt(two.square) ||
      two.minus_log > noise.minus_log - kBeyondDoubt || !lie_at_random(table, some, two))
    return {};
  SecondPlace found{.share = two.share,
                    .these_um = {two.at_um[0][0], two.at_um[0][1]},
                    .others_um = {two.at_um[1][0], two.at_um[1][1]},
                    .rows = {},
                    .p_value = std::max(kSurest, std::exp(two.minus_log - noise.minus_log))};
  // Drawn by how likely each is: the likelier place of all would leave less than the noise.
  for_points(geometry, table, patches, row_um, 1, [&](const LeftOfPoint& p) {
    if (std::ldexp(static_cast<double>(mixed_bits(p.row)), -64) < two.of_first(p).first)
      found.rows.push_back(p.row);
  });
  return found;
}

}  // namespace trueflank::loop
