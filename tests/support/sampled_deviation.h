// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <variant>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/solid/measure/triangle_tree.h"
#include "trueflank/solid/shape/part_shape.h"

// How far a mesh is from its part, by another way than solid/measure/mesh_accuracy: the surface is
// only ever walked on (surface_point()), nothing is folded, turned back or taken apart. Slow, and
// at random places only.
namespace trueflank::test {

struct SampledDeviation {
  double facets_to_surface_mm = 0.0;
  double surface_to_facets_mm = 0.0;
  std::array<double, 3> worst_place_mm{};

  [[nodiscard]] double largest_mm() const {
    return std::max(facets_to_surface_mm, surface_to_facets_mm);
  }
};

/// One toothed outline, walked on.
class WalkedToothing {
 public:
  explicit WalkedToothing(const ToothedOutline& outline)
      : outline_(outline), toothing_(outline.toothing()) {}

  /// Frame: the part's.
  [[nodiscard]] Point3 at(const ToothPlace& place, double z_mm) const {
    const auto p = surface_point(toothing_, place, z_mm - outline_.z_lower_mm);
    const Point2 turned = rotated({p[0], p[1]}, outline_.rotation_rad);
    return {turned.x(), turned.y(), p[2] + outline_.z_lower_mm};
  }
  [[nodiscard]] const Curve& curve(std::size_t piece) const {
    return toothing_.profile->pieces()[piece].curve;
  }
  [[nodiscard]] std::size_t pieces() const { return toothing_.profile->pieces().size(); }
  [[nodiscard]] int teeth() const { return toothing_.profile->gear().teeth; }

  /// To the nearest point of the surface between two heights; stops early at a point no farther
  /// than `enough_mm`.
  [[nodiscard]] double distance_mm(const Point3& p, double low_mm, double high_mm,
                                   double enough_mm) const {
    const double z = std::clamp(p.z(), low_mm, high_mm);
    struct Start {
      double distance_mm;
      ToothPlace place;
    };
    std::vector<Start> starts;
    const double turn = section_turn_rad(toothing_.twist, z - outline_.z_lower_mm);
    const double tooth =
        (std::atan2(p.y(), p.x()) - outline_.rotation_rad - turn) / (kTwoPi / teeth());
    for (const int near : {0, -1, 1})
      for (const int side : {1, -1})
        for (std::size_t piece = 0; piece < pieces(); ++piece) {
          const int index = (static_cast<int>(std::lround(tooth)) + near) % teeth();
          const ToothPlace place{index < 0 ? index + teeth() : index, side, piece, 0.0};
          const ToothPlace nearest = nearest_at_height(p, place, z);
          starts.push_back({(at(nearest, z) - p).norm(), nearest});
          if (starts.back().distance_mm <= enough_mm) return starts.back().distance_mm;
        }
    std::sort(starts.begin(), starts.end(),
              [](const Start& a, const Start& b) { return a.distance_mm < b.distance_mm; });
    double best = starts.front().distance_mm;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, starts.size()); ++k)
      best = std::min(best, over_heights(p, starts[k].place, low_mm, high_mm, best));
    return best;
  }

 private:
  static constexpr int kSteps = 16;

  template <class Function>
  [[nodiscard]] static double smallest_at(const Function& f, double low, double high) {
    constexpr double kGolden = 0.6180339887498949;
    double c = high - kGolden * (high - low), d = low + kGolden * (high - low);
    double at_c = f(c), at_d = f(d);
    for (int k = 0; k < 40; ++k)
      if (at_c < at_d) {
        high = d, d = c, at_d = at_c;
        at_c = f(c = high - kGolden * (high - low));
      } else {
        low = c, c = d, at_c = at_d;
        at_d = f(d = low + kGolden * (high - low));
      }
    return 0.5 * (low + high);
  }

  /// On the piece of `place`, at one height.
  [[nodiscard]] ToothPlace nearest_at_height(const Point3& p, ToothPlace place, double z_mm) const {
    const Curve& c = curve(place.piece);
    const auto distance = [&](double share) {
      place.parameter = c.begin + share * (c.end - c.begin);
      return (at(place, z_mm) - p).squaredNorm();
    };
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i)
      if (const double d = distance(static_cast<double>(i) / kSteps); d < least)
        least = d, nearest = i;
    const double share = smallest_at(distance, std::max(0.0, (nearest - 1.0) / kSteps),
                                     std::min(1.0, (nearest + 1.0) / kSteps));
    static_cast<void>(distance(share));
    return place;
  }

  /// From a place on, up and down by a few times the distance there.
  [[nodiscard]] double over_heights(const Point3& p, const ToothPlace& start, double low_mm,
                                    double high_mm, double distance_mm) const {
    const auto distance = [&](double z) {
      return (at(nearest_at_height(p, start, z), z) - p).norm();
    };
    const double z = smallest_at(distance, std::max(low_mm, p.z() - 3.0 * distance_mm),
                                 std::min(high_mm, p.z() + 3.0 * distance_mm));
    return std::min({distance(z), distance(std::clamp(p.z() - 3.0 * distance_mm, low_mm, high_mm)),
                     distance(std::clamp(p.z() + 3.0 * distance_mm, low_mm, high_mm))});
  }

  ToothedOutline outline_;
  Toothing toothing_;
};

/// Measures a mesh at so many random places each way. Nothing for parts with bores that are not
/// round, bed chamfers or displacements, whose walls are not walked on here.
[[nodiscard]] inline std::optional<SampledDeviation> sampled_deviation(const TriangleMesh& mesh,
                                                                       const PartShape& part,
                                                                       int places,
                                                                       std::uint64_t seed,
                                                                       double enough_mm) {
  struct Wall {
    double low_mm, high_mm;
    std::optional<WalkedToothing> teeth;
    CircleOutline circle;
  };
  std::vector<Wall> walls;
  std::vector<double> planes;
  for (const Slab& slab : part.slabs) {
    planes.insert(planes.end(), {slab.z_lower_mm, slab.z_upper_mm});
    std::vector<Outline> outlines = slab.holes;
    outlines.push_back(slab.outer);
    for (const Outline& outline : outlines) {
      Wall wall{slab.z_lower_mm, slab.z_upper_mm, {}, {}};
      if (const auto* toothed = std::get_if<ToothedOutline>(&outline)) {
        if (toothed->bed || toothed->displacement) return std::nullopt;
        wall.teeth.emplace(*toothed);
      } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
        if (circle->bed.height_mm > 0.0) return std::nullopt;
        wall.circle = *circle;
      } else {
        const auto& bore = std::get<BoreOutline>(outline);
        if (bore.bore.kind != BoreKind::kRound || bore.bed.height_mm > 0.0) return std::nullopt;
        wall.circle.radius_mm = 0.5 * bore.bore.diameter_mm;
      }
      walls.push_back(std::move(wall));
    }
  }
  std::mt19937_64 engine(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  const auto index = [&](std::size_t count) { return static_cast<std::size_t>(engine() % count); };
  SampledDeviation result;
  const auto is_off = [&](double distance, const Point3& p, double& largest) {
    if (distance > result.largest_mm()) result.worst_place_mm = {p.x(), p.y(), p.z()};
    largest = std::max(largest, distance);
  };

  const TriangleTree tree(mesh);
  for (int i = 0; i < places; ++i) {
    const Wall& wall = walls[index(walls.size())];
    const double z = between(wall.low_mm, wall.high_mm);
    Point3 p;
    if (wall.teeth) {
      const std::size_t piece = index(wall.teeth->pieces());
      const Curve& c = wall.teeth->curve(piece);
      p = wall.teeth->at({static_cast<int>(index(static_cast<std::size_t>(wall.teeth->teeth()))),
                          engine() % 2 == 0 ? 1 : -1, piece, between(c.begin, c.end)},
                         z);
    } else {
      p << wall.circle.centre + wall.circle.radius_mm * unit_vector(between(0.0, kTwoPi)), z;
    }
    is_off(tree.nearest(p).distance_mm, p, result.surface_to_facets_mm);
  }
  for (int i = 0; i < places; ++i) {
    const auto& t = mesh.triangles[index(mesh.triangles.size())];
    double u = between(0.0, 1.0), v = between(0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    if (i % 3 == 0) v = 0.0;  // chords are farthest off on edges
    const Point3 a(mesh.vertices[t[0]].data()), b(mesh.vertices[t[1]].data()),
        c(mesh.vertices[t[2]].data());
    const Point3 p = a + u * (b - a) + v * (c - a), normal = (b - a).cross(c - a).normalized();
    double distance = std::numeric_limits<double>::infinity();
    if (std::abs(normal.z()) > 0.9999)
      for (const double plane : planes) distance = std::min(distance, std::abs(p.z() - plane));
    for (const Wall& wall : walls) {
      if (distance <= enough_mm) break;
      if (p.z() < wall.low_mm - enough_mm || p.z() > wall.high_mm + enough_mm) continue;
      if (wall.teeth) {
        distance =
            std::min(distance, wall.teeth->distance_mm(p, wall.low_mm, wall.high_mm, enough_mm));
      } else {
        const double beyond = std::max({0.0, wall.low_mm - p.z(), p.z() - wall.high_mm});
        distance = std::min(
            distance,
            std::hypot((p.head<2>() - wall.circle.centre).norm() - wall.circle.radius_mm, beyond));
      }
    }
    is_off(distance, p, result.facets_to_surface_mm);
  }
  return result;
}

}  // namespace trueflank::test
