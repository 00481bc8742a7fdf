// SPDX-License-Identifier: GPL-3.0-or-later
// Feet of four points at once, in wide registers. Compiled without the error numbers of square
// roots (CMakeLists.txt), so that four of them are one instruction.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "trueflank/base/four_arc_tangents.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/gear/flank_geometry.h"

namespace trueflank::loop {
namespace {

/// As base/elementary_functions.cpp has them for one number.
struct FourAtOnce {
  using Value = Four;
  [[gnu::always_inline]] static Four where(const FourWords& is, const Four& a, const Four& b) {
    return is ? a : b;
  }
  [[gnu::always_inline]] static Four square_root(const Four& x) {
    Four root;
    for (int k = 0; k < 4; ++k) root[k] = __builtin_sqrt(x[k]);
    return root;
  }
  [[gnu::always_inline]] static Four arc_tangent(const Four& x) { return arc_tangents(x); }
  [[gnu::always_inline]] static Four arc_tangent(const Four& y, const Four& x) {
    return arc_tangents(y, x);
  }
  [[gnu::always_inline]] static Four arc_tangent_unless(const FourWords& are_near, const Four& a,
                                                        const Four& near) {
    if (all(are_near)) return near;
    return are_near ? near : arc_tangent(a);
  }
  /// Halves away from zero.
  [[gnu::always_inline]] static Four nearest_number(const Four& x) {
    constexpr double kRoundsToInteger = 0x1.8p52;
    const Four even = (x + kRoundsToInteger) - kRoundsToInteger, rest = x - even;
    const Four up = ((rest == 0.5) & (x > 0.0)) ? even + 1.0 : even;
    return ((rest == -0.5) & (x < 0.0)) ? up - 1.0 : up;
  }
  [[gnu::always_inline]] static Four wrapped(const Four& number, int teeth) {
    const double z = teeth;
    if (all((number > -z) & (number < z))) return number < 0.0 ? number + z : number;
    Four tooth;
    for (int k = 0; k < 4; ++k) tooth[k] = OneAtATime::wrapped(number[k], teeth);
    return tooth;
  }
  /// Not a number where it is further: asked of each point alone then.
  [[gnu::always_inline]] static Four within_half_a_turn(const Four& turn) {
    return sizes(turn) <= kPi ? turn : Four{} + kNaN;
  }
};

using Feet = Foot<FourAtOnce>;

[[gnu::always_inline]] inline Foot<OneAtATime> one_of(const Feet& feet, std::size_t k) {
  return {.tooth = feet.tooth[k],
          .side = feet.side[k],
          .radius = feet.radius[k],
          .polar = feet.polar[k],
          .roll = feet.roll[k],
          .z = feet.z[k],
          .distance = feet.distance[k],
          .place_radius = feet.place_radius[k],
          .place_polar = feet.place_polar[k],
          .normal = feet.normal[k],
          .turn = feet.turn[k],
          .from = {feet.from[0][k], feet.from[1][k]},
          .to = {feet.to[0][k], feet.to[1][k]},
          .normal_direction = {feet.normal_direction[0][k], feet.normal_direction[1][k]}};
}

}  // namespace

/// `take(i, found)` for every point, in order.
template <class Take>
void FlankGeometry::for_feet(std::span<const std::array<double, 3>> points_mm, double margin,
                             const Take& take) const {
  const ToothedCylinder g = cylinder();
  for (std::size_t first = 0; first < points_mm.size(); first += 4) {
    const std::size_t count = std::min<std::size_t>(4, points_mm.size() - first);
    double p[3][4];
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis][k] = points_mm[first + std::min(k, count - 1)][axis];
    Feet feet;
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      Four x, y, z;
      std::memcpy(&x, p[0], sizeof x);
      std::memcpy(&y, p[1], sizeof y);
      std::memcpy(&z, p[2], sizeof z);
      feet = foot_of<FourAtOnce>(g, x, y, z);
    });
    for (std::size_t k = 0; k < count; ++k) {
      const Foot<OneAtATime> foot = one_of(feet, k);
      take(first + k, std::isnan(foot.turn) ? undirected_flank(points_mm[first + k], margin)
                                            : found_at(foot, margin));
    }
  }
}

void FlankGeometry::nearest_flanks(std::span<const std::array<double, 3>> points_mm, double margin,
                                   PlacedPoint* found) const {
  for_feet(points_mm, margin, [&](std::size_t i, const Undirected& flank) {
    found[i] = {flank.is_directed ? flank.place : directed(flank), flank.distance_mm};
  });
}

void FlankGeometry::nearest(std::span<const std::array<double, 3>> points_mm, double reach_mm,
                            PlacedPoint* found) const {
  for_feet(points_mm, kFlankMargin, [&](std::size_t i, const Undirected& flank) {
    const bool is_near =
        flank.place.surface == Surface::kFlank && std::abs(flank.distance_mm) < reach_mm;
    const Undirected nearest =
        is_near ? flank : beside_flank(points_mm[i], flank.place.tooth, reach_mm);
    found[i] = {nearest.is_directed ? nearest.place : directed(nearest), nearest.distance_mm};
  });
}

void FlankGeometry::nearest_distances_mm(std::span<const std::array<double, 3>> points_mm,
                                         double reach_mm, double* found) const {
  for_feet(points_mm, kFlankMargin, [&](std::size_t i, const Undirected& flank) {
    if (flank.place.surface == Surface::kFlank && std::abs(flank.distance_mm) < reach_mm) {
      found[i] = std::abs(flank.distance_mm);
      return;
    }
    const Undirected beside = beside_flank(points_mm[i], flank.place.tooth, reach_mm);
    found[i] = beside.place.surface == Surface::kNone ? kNaN : std::abs(beside.distance_mm);
  });
}

}  // namespace trueflank::loop
