// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/section_waves.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Sums over the values at about one height, of the parts of their normals along x and y and of
/// what is left there.
struct SumsAtHeight {
  double xx = 0.0, xy = 0.0, yy = 0.0, xr = 0.0, yr = 0.0;
};

constexpr int kHeights = 240;

std::array<SumsAtHeight, kHeights> sums_over_heights(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const Patches& patches,
                                                     const std::vector<float>& row_um) {
  std::array<SumsAtHeight, kHeights> sums{};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if ((row.kind != ObservationKind::kHelix && row.kind != ObservationKind::kScanFlank) ||
        row.places != 1 || patches.patch_of_row[i] < 0 || !std::isfinite(row_um[i]))
      continue;
    const Place& place = table.place(row);
    if (place.surface != Surface::kFlank) continue;
    const double share = place.z_mm / geometry.face_width_mm();
    const auto at =
        static_cast<std::size_t>(std::clamp(static_cast<int>(share * kHeights), 0, kHeights - 1));
    const double x = normal_part(geometry, place, 1.0, 0.0),
                 y = normal_part(geometry, place, 0.0, 1.0), r = row_um[i];
    SumsAtHeight& sum = sums[at];
    sum.xx += x * x;
    sum.xy += x * y;
    sum.yy += y * y;
    sum.xr += x * r;
    sum.yr += y * r;
  }
  return sums;
}

/// Courses over the height, each along x and along y, fitted to the sums.
template <int kCourses>
struct Fitted {
  using Values = Eigen::Matrix<double, 2 * kCourses, 1>;
  Values parts = Values::Zero();  ///< along x, then along y, of each course
  double square = 0.0;            ///< taken out
};
template <int kCourses, class CoursesAt>
Fitted<kCourses> fitted(const std::array<SumsAtHeight, kHeights>& sums,
                        const CoursesAt& courses_at) {
  constexpr double kRidge = 1e-9;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(2 * kCourses, 2 * kCourses);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * kCourses);
  for (int h = 0; h < kHeights; ++h) {
    const SumsAtHeight& sum = sums[static_cast<std::size_t>(h)];
    const std::array<double, kCourses> course = courses_at((h + 0.5) / kHeights);
    for (int i = 0; i < kCourses; ++i) {
      const double at_i = course[static_cast<std::size_t>(i)];
      for (int k = 0; k <= i; ++k) {
        const double both = at_i * course[static_cast<std::size_t>(k)];
        normal(2 * i, 2 * k) += both * sum.xx;
        normal(2 * i, 2 * k + 1) += both * sum.xy;
        normal(2 * i + 1, 2 * k) += both * sum.xy;
        normal(2 * i + 1, 2 * k + 1) += both * sum.yy;
      }
      right[2 * i] += at_i * sum.xr;
      right[2 * i + 1] += at_i * sum.yr;
    }
  }
  for (int i = 0; i < 2 * kCourses; ++i)
    for (int k = i + 1; k < 2 * kCourses; ++k) normal(i, k) = normal(k, i);
  if (!(normal.trace() > 0.0)) return {};
  normal.diagonal().array() += kRidge * normal.trace();
  Fitted<kCourses> found;
  found.parts = symmetric_solution(normal, right);
  found.square = found.parts.dot(right);
  return found;
}

/// The ellipse of (x, y) = m (cos, sin).
SectionWave ellipse_of(const Eigen::Matrix2d& m) {
  const double xx = m.row(0).squaredNorm(), yy = m.row(1).squaredNorm(),
               xy = m.row(0).dot(m.row(1));
  double turned = 0.5 * std::atan2(2.0 * xy, xx - yy);
  if (turned < 0.0) turned += kPi;  // to and fro
  SectionWave wave;
  wave.towards_deg = deg_from_rad(turned);
  wave.along_um = (std::cos(turned) * m.row(0) + std::sin(turned) * m.row(1)).norm();
  wave.across_um = (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0)) / std::max(1e-12, wave.along_um);
  return wave;
}

using Sums = std::array<SumsAtHeight, kHeights>;

std::vector<SectionWave> likeliest_waves(const FlankGeometry& geometry, const Sums& sums) {
  // Longer ones are a bend of the axis; shorter ones need heights to be seen at.
  constexpr double kFewest = 0.75, kStep = 0.05, kHeightsOfOne = 3.0, kApart = 0.5;
  constexpr std::size_t kFew = 3;
  const auto seen = std::count_if(sums.begin(), sums.end(),
                                  [](const SumsAtHeight& sum) { return sum.xx + sum.yy > 0.0; });
  const double most = static_cast<double>(seen) / kHeightsOfOne;
  const double without = fitted<2>(sums, [](double share) {
                           return std::array<double, 2>{1.0, share - 0.5};
                         }).square;
  std::vector<SectionWave> waves;
  for (double count = kFewest; count <= most; count += kStep) {
    const auto found = fitted<4>(sums, [&](double share) {
      const double angle = kTwoPi * count * share;
      return std::array<double, 4>{1.0, share - 0.5, std::cos(angle), std::sin(angle)};
    });
    Eigen::Matrix2d m;
    m << found.parts[4], found.parts[6], found.parts[5], found.parts[7];
    SectionWave wave = ellipse_of(m);
    wave.wavelength_mm = geometry.face_width_mm() / count;
    wave.square = found.square - without;
    waves.push_back(wave);
  }
  std::stable_sort(waves.begin(), waves.end(),
                   [](const SectionWave& a, const SectionWave& b) { return a.square > b.square; });
  std::vector<SectionWave> best;
  for (const SectionWave& wave : waves) {
    const double count = geometry.face_width_mm() / wave.wavelength_mm;
    const bool near = std::any_of(best.begin(), best.end(), [&](const SectionWave& other) {
      return std::abs(geometry.face_width_mm() / other.wavelength_mm - count) < kApart;
    });
    if (near) continue;
    best.push_back(wave);
    if (best.size() == kFew) break;
  }
  return best;
}

/// Heights above which sections stand aside once and once more: the likeliest of a coarse grid,
/// then moved in turn.
std::array<double, 2> likeliest_steps_mm(const FlankGeometry& geometry, const Sums& sums) {
  constexpr int kGrid = 10, kRounds = 2;  // heights
  const auto square = [&](const std::array<int, 2>& steps) {
    return fitted<3>(sums,
                     [&](double share) {
                       const double at = share * kHeights;
                       return std::array<double, 3>{1.0, at > steps[0] ? 1.0 : 0.0,
                                                    at > steps[1] ? 1.0 : 0.0};
                     })
        .square;
  };
  std::array<int, 2> best{};
  double most = 0.0;
  const auto keep_best = [&](const std::array<int, 2>& steps) {
    const double taken_out = square(steps);
    if (!(taken_out > most)) return;
    most = taken_out;
    best = steps;
  };
  for (int low = kGrid; low < kHeights; low += kGrid)
    for (int high = low + kGrid; high < kHeights; high += kGrid) keep_best({low, high});
  for (int round = 0; round < kRounds; ++round)
    for (const std::size_t k : {0U, 1U}) {
      const std::array<int, 2> from = best;
      for (int off = 1 - kGrid; off < kGrid; ++off) {
        std::array<int, 2> steps = from;
        steps[k] += off;
        if (steps[0] < steps[1] && steps[0] > 0 && steps[1] < kHeights) keep_best(steps);
      }
    }
  const double height_mm = geometry.face_width_mm() / kHeights;
  return {best[0] * height_mm, best[1] * height_mm};
}

}  // namespace

SectionsAside sections_aside(const FlankGeometry& geometry, const Observations& table,
                             const Patches& patches, const std::vector<float>& row_um) {
  const Sums sums = sums_over_heights(geometry, table, patches, row_um);
  return {.waves = likeliest_waves(geometry, sums), .steps_mm = likeliest_steps_mm(geometry, sums)};
}

}  // namespace trueflank::loop
