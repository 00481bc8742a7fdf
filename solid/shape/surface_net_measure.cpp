// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a net of modified teeth keeps the tolerance: every facet against the surface.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/surface_net.h"

namespace trueflank {
namespace {

/// Where a chord's middle lies farther from the surface's own, it is looked for.
constexpr double kOffMiddle = 0.02;

/// Facets of chamfers are off by as much nearly everywhere, and between the places looked at by up
/// to so many times more.
constexpr double kOfChamfers = 1.025;

/// Largest distance of a facet from the surface, whose point over the share of the edge from p to q
/// is over(p, q, share). In a strip edges may bend in one half alone.
template <typename Corner, typename Over>
double facet_error(const std::array<Corner, 3>& corner, bool in_strip, const Over& over) {
  using Space3 = decltype(Corner::point);
  const Space3 normal =
      (corner[1].point - corner[0].point).cross(corner[2].point - corner[0].point).normalized();
  std::array<double, 3> middle{};
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &p = corner[k], &q = corner[(k + 1) % 3];
    for (const double share : {0.5, 0.25, 0.75}) {
      if (share != 0.5 && !in_strip) break;
      const Space3 away = over(p, q, share) - p.point;
      const double off = away.dot(normal);
      // an end face's edge has the surface on one side only
      if (share == 0.5 && p.z == q.z) {
        const Space3 chord = (q.point - p.point).normalized();
        largest = std::max(largest, (away - chord * away.dot(chord)).norm());
      }
      if (share == 0.5) middle[k] = off;
      largest = std::max(largest, std::abs(off));
    }
  }
  return std::max(largest, triangle_error(middle[0], middle[1], middle[2]));
}

}  // namespace

/// The point of the surface over the share of a facet's edge.
ToothingGrid::SurfaceNet::Space3 ToothingGrid::SurfaceNet::over_edge(int tooth,
                                                                     const Place& surface,
                                                                     const At& p, const At& q,
                                                                     double share) const {
  const Space3 chord = q.point - p.point;
  const double length2 = chord.squaredNorm();
  double at = share;
  Space3 found;
  for (int i = 0; i < 4; ++i) {
    found = on(tooth, {surface.side, surface.piece, std::lerp(p.parameter, q.parameter, at)},
               std::lerp(p.z, q.z, at));
    const double off = (found - p.point).dot(chord) / length2 - share;
    if (!(std::abs(off) > kOffMiddle)) break;
    at = std::clamp(at - off, 0.0, 1.0);
  }
  return found;
}

void ToothingGrid::SurfaceNet::measure(const NetPatch& net, int tooth, Aims& errors) const {
  const std::size_t n = net_.size();
  const bool moved = g_.toothing_.displacement != nullptr;
  for (std::size_t t = 0; t < net.facets.size(); ++t) {
    const auto& facet = net.facets[t];
    const int first = std::min({facet[0].column, facet[1].column, facet[2].column});
    const std::size_t edge = static_cast<std::size_t>(first) % n;
    const Place& surface = g_.middles_[edge];
    std::array<At, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto column = static_cast<std::size_t>(facet[k].column);
      const auto& rows = net.inner[column % n];
      const auto row = static_cast<std::size_t>(facet[k].row);
      const double share = row == 0 ? 0.0 : row > rows.size() ? 1.0 : rows[row - 1];
      const bool at_end = net.region[t] != net_[column % n].region;
      const Place place = on_land(edge) ? g_.points_[column % n]
                                        : end_of((at_end ? column + n - 1 : column) % n, at_end);
      corner[k] = {place.parameter, height_of(patch_, share)};
      const int next = on_land(edge) ? static_cast<int>(column / n) : 0,
                of_tooth = (tooth + next) % g_.teeth_;
      corner[k].point = on(of_tooth, place, corner[k].z);
      if (!moved || !on_land(edge)) continue;
      const Point p =
          surface_point(unmoved_, g_.place_at(place, of_tooth, corner[k].z), corner[k].z);
      corner[k].before = Space3(p.data());
    }
    const auto over_flank = [&](const At& p, const At& q, double share) {
      return over_edge(tooth, surface, p, q, share);
    };
    const auto over_land = [&](const At& p, const At& q, double) {
      return over_moved_middle(p, q);
    };
    const bool in_strip = net_[edge].developable || net_[edge].across;
    const double seen = !on_land(edge) ? facet_error(corner, in_strip, over_flank)
                        : moved        ? facet_error(corner, false, over_land)
                                       : land_error(corner);
    const double error = net_[edge].in_chamfer ? kOfChamfers * seen : seen;
    const auto [low_sample, high_sample] = samples(
        surface.piece, std::min({corner[0].parameter, corner[1].parameter, corner[2].parameter}),
        std::max({corner[0].parameter, corner[1].parameter, corner[2].parameter}));
    auto& charged = errors[aims_of(patch_, surface.piece)];
    for (std::size_t k = low_sample; k < high_sample; ++k) charged[k] = std::max(charged[k], error);
  }
}

/// The point that the displacement makes of a land's over the middle of a facet's edge: it bends
/// what was a cylinder or cone.
ToothingGrid::SurfaceNet::Space3 ToothingGrid::SurfaceNet::over_moved_middle(const At& p,
                                                                             const At& q) const {
  const Space3 half = 0.5 * (p.before + q.before);
  const double radius = 0.5 * (p.before.head<2>().norm() + q.before.head<2>().norm());
  const Eigen::Vector2d there = radius * half.head<2>().normalized();
  const std::array<double, 3> before{there.x(), there.y(), half.z()};
  const std::array<double, 3> moved = (*g_.toothing_.displacement)(before);
  return Space3(before.data()) + Space3(moved.data());
}

/// Lands are cylinders about the axis, cones where a chamfer lowers tips.
double ToothingGrid::SurfaceNet::land_error(const std::array<At, 3>& corner) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Space3 &p = corner[k].point, &q = corner[(k + 1) % 3].point;
    const double radius = 0.5 * (p.head<2>().norm() + q.head<2>().norm());
    largest = std::max(largest, std::abs(radius - (0.5 * (p + q)).head<2>().norm()));
  }
  return largest;
}

}  // namespace trueflank
