// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/alike_over_height.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {
namespace {

struct PointOfFlank {
  double x_mm = 0.0, y_mm = 0.0, z_mm = 0.0, u = 0.0, v = 0.0, um = 0.0;
};
using PointsOfFlank = std::vector<PointOfFlank>;

/// Takes a surface of the second degree off; false where there are too few points for it.
bool take_surface_off(PointsOfFlank& points) {
  constexpr Eigen::Index kTerms = 6, kFewest = 40;
  const Eigen::Index n = std::ssize(points);
  if (n < kFewest) return false;
  Eigen::MatrixXd terms(n, kTerms);
  Eigen::VectorXd um(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointOfFlank& p = points[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v;
    um[i] = p.um;
  }
  um -= terms * terms.colPivHouseholderQr().solve(um);
  const double widened = std::sqrt(static_cast<double>(n) / static_cast<double>(n - kTerms));
  for (Eigen::Index i = 0; i < n; ++i) points[static_cast<std::size_t>(i)].um = widened * um[i];
  return true;
}

/// Root of the mean square of values that are no wild ones.
double rms_of_usual(const std::vector<double>& values) {
  constexpr double kWild = 4.0;
  const double most = kWild * robust_sigma(values);
  double square = 0.0, count = 0.0;
  for (const double value : values)
    if (std::abs(value) <= most) {
      square += value * value;
      count += 1.0;
    }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

/// Differences of points nearer than this in the section and far apart in height. The points stand
/// in the order of x.
std::vector<double> differences(const std::map<int, PointsOfFlank>& flanks, double near_mm,
                                double apart_mm) {
  std::vector<double> found;
  for (const auto& [flank, points] : flanks)
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = i + 1; k < points.size() && points[k].x_mm - points[i].x_mm < near_mm;
           ++k)
        if (std::abs(points[k].y_mm - points[i].y_mm) < near_mm &&
            std::abs(points[k].z_mm - points[i].z_mm) > apart_mm)
          found.push_back((points[k].um - points[i].um) / std::sqrt(2.0));
  return found;
}

}  // namespace

std::optional<AlikeOverHeight> alike_over_height(const FlankGeometry& geometry,
                                                 const Observations& table,
                                                 const std::vector<float>& row_um,
                                                 const std::vector<bool>& used) {
  constexpr std::size_t kMostRows = 40'000, kFewestPairs = 300;
  constexpr double kApart = 0.3;  // of the face: errors of neighbours may hang together
  constexpr double kLeast_mm = 0.001, kMost_mm = 0.02;
  // (errors that hang together from line to line differ less over the height, by up to a third)
  constexpr double kClearly = 1.5;
  std::map<int, PointsOfFlank> flanks;
  const ThinnedRows some(table.points_mm.size(), kMostRows);
  for (std::size_t i = 0; i < table.points_mm.size(); ++i) {
    if (!some.has(i) || !used[i] || table.rows[i].kind != ObservationKind::kScanFlank) continue;
    const Place& place = table.place(table.rows[i]);
    flanks[2 * place.tooth + (place.side > 0 ? 1 : 0)].push_back(
        {place.radius_mm * place.polar_direction[0], place.radius_mm * place.polar_direction[1],
         place.z_mm, geometry.profile_coordinate(place.roll_mm),
         geometry.face_coordinate(place.z_mm), row_um[i]});
  }
  for (auto flank = flanks.begin(); flank != flanks.end();)
    flank = take_surface_off(flank->second) ? std::next(flank) : flanks.erase(flank);
  std::vector<double> all;
  for (auto& [flank, points] : flanks) {
    std::sort(points.begin(), points.end(),
              [](const PointOfFlank& a, const PointOfFlank& b) { return a.x_mm < b.x_mm; });
    for (const PointOfFlank& p : points) all.push_back(p.um);
  }
  std::vector<double> pairs;
  for (double near_mm = kLeast_mm; pairs.size() < kFewestPairs && near_mm < kMost_mm;
       near_mm *= 2.0)
    pairs = differences(flanks, near_mm, kApart * geometry.face_width_mm());
  if (pairs.size() < kFewestPairs) return {};
  const double whole_um = rms_of_usual(all), noise_um = rms_of_usual(pairs);
  if (!(noise_um > 0.0) || whole_um < kClearly * noise_um) return {};
  // (a point stands in several pairs)
  const double known = 0.5 * static_cast<double>(std::min(pairs.size(), all.size()));
  return AlikeOverHeight{
      .pattern_um = std::sqrt(whole_um * whole_um - noise_um * noise_um),
      .noise_um = noise_um,
      .p_value = f_tail(std::pow(whole_um / noise_um, 2), static_cast<double>(all.size()), known)};
}

}  // namespace trueflank::loop
