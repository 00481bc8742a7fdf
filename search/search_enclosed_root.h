// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/basic_rack.h"
#include "trueflank/search/search_interval.h"

// Roots of gears for numbers that enclose: where they leave the involute, and how far a mate's tip
// corner stays from one place of them. T is double, Interval or Slope; module 1.
namespace trueflank {

template <class T>
struct EnclosedGear {
  int teeth = 0;
  bool ring = false;
  T shift{0.0};
  double base_radius = 0.0;
  T base_half_angle{0.0};
  T tip{0.0}, root{0.0};  ///< radii
};

/// Tangent of the pressure angle at a radius; 0 inside the base circle.
inline double tangent_at(double radius, double base) {
  return std::sqrt(std::max(0.0, (radius - base) * (radius + base))) / base;
}
template <class T>
T tangent_at(const T& radius, double base) {
  return sqrt((radius - T(base)) * (radius + T(base))) / T(base);
}
template <class T>
T involute_at(const EnclosedGear<T>& gear, const T& radius) {
  return involute_of_tangent(tangent_at(radius, gear.base_radius));
}
/// Of a tooth.
template <class T>
T half_angle_at(const EnclosedGear<T>& gear, const T& radius) {
  const T inv = involute_at(gear, radius);
  return gear.ring ? gear.base_half_angle + inv : gear.base_half_angle - inv;
}

/// Roll length at which the rack's straight flank begins to cut; below 0: undercut.
template <class T>
T straight_start(const BasicRack& rack, const EnclosedGear<T>& gear) {
  const double sine = std::sin(rack.pressure_angle_rad);
  const double rounding =
      std::clamp(rack.root_radius, 0.0, std::max(0.0, full_round_coefficient(rack)));
  return T(0.5 * gear.teeth * sine - (rack.dedendum - rounding * (1.0 - sine)) / sine) +
         gear.shift * T(1.0 / sine);
}

/// Roll length of the root form point. Of an undercut gear it falls with the shift (the tool with a
/// larger shift lies inside the tool with a smaller one, flank upon flank): profiles at the ends of
/// the range enclose it.
[[nodiscard]] Interval root_form_roll(const BasicRack& rack, const EnclosedGear<Interval>& gear);
[[nodiscard]] Slope root_form_roll(const BasicRack& rack, const EnclosedGear<Slope>& gear);

/// A place of a root curve: of an external gear the angle of the rack corner's normal; of a ring
/// the angle about its fillet's centre, from the root circle.
struct RootPlace {
  bool found = false;
  double at = 0.0;
};
/// About where a mate's tip corner comes closest to a root; not found where it stays farther than
/// `near`.
[[nodiscard]] RootPlace closest_place(const BasicRack& rack, const EnclosedGear<double>& own,
                                      const EnclosedGear<double>& mate, double a, double near);
/// Whether a place is on the root curve all over a box. `way`: from the box's middle.
[[nodiscard]] bool surely_root(const BasicRack& rack, const EnclosedGear<Slope>& whole,
                               const EnclosedGear<Interval>& middle,
                               const std::array<Interval, 3>& way, const RootPlace& place);

/// A point of a root curve: its radius and its angle from the gap's middle.
template <class T>
struct RootPoint {
  T radius, gap;
};

/// Of the rack's trochoid (docs/theory/tooth-profile.md).
template <class T>
RootPoint<T> trochoid_point(const BasicRack& rack, const EnclosedGear<T>& gear, double t) {
  const double tangent = std::tan(rack.pressure_angle_rad), r = 0.5 * gear.teeth;
  const double rounding =
      std::clamp(rack.root_radius, 0.0, std::max(0.0, full_round_coefficient(rack)));
  const double half_land = std::max(0.0, 0.25 * kPi - rack.dedendum * tangent -
                                             rounding * (1.0 - std::sin(rack.pressure_angle_rad)) /
                                                 std::cos(rack.pressure_angle_rad));
  const T depth = T(rack.dedendum - rounding + rounding * std::sin(t)) - gear.shift;
  const T lateral = depth * T(std::cos(t) / std::sin(t));
  const T travel = T(half_land + rounding * std::cos(t)) - lateral;
  const T along = T(r) - depth;
  return {sqrt(square(along) + square(lateral)), travel * T(1.0 / r) + atan(lateral / along)};
}

/// Of a ring's fillet whose radius is not reduced.
template <class T>
RootPoint<T> ring_fillet_point(const BasicRack& rack, const EnclosedGear<T>& gear, double turn) {
  const double rho = rack.root_radius;
  const T centre = gear.root - T(rho);
  const T angle = gear.base_half_angle + T(rho / gear.base_radius) + involute_at(gear, centre);
  const T along = centre + T(rho * std::cos(turn));
  const T across(rho * std::sin(turn));
  return {sqrt(square(along) + square(across)), T(kPi / gear.teeth) - angle + atan(across / along)};
}
template <class T>
RootPoint<T> root_point(const BasicRack& rack, const EnclosedGear<T>& gear,
                        const RootPlace& place) {
  return gear.ring ? ring_fillet_point(rack, gear, place.at) : trochoid_point(rack, gear, place.at);
}

/// In the triangle of both axes and the corner: how far the corner has turned with the mate from
/// the line of centres, times the gears' ratio, less where it stands as seen from the own axis.
struct CornerTriangle {
  bool own_ring = false, mate_ring = false;
  double per_gear = 0.0;  ///< teeth of the mate / teeth of the own gear

  template <class T>
  [[nodiscard]] T turned_of(const T& a, const T& tip, const T& radius) const {
    const T at_mate = (square(a) + square(tip) - square(radius)) / (T(2.0) * a * tip),
            at_own = (square(a) + square(radius) - square(tip)) / (T(2.0) * a * radius);
    return T(per_gear) * acos(own_ring ? -at_mate : at_mate) - acos(mate_ring ? -at_own : at_own);
  }
  [[nodiscard]] double turned(double a, double tip, double radius) const {
    return turned_of(a, tip, radius);
  }
  [[nodiscard]] Interval turned(const Interval& a, const Interval& tip,
                                const Interval& radius) const {
    return turned_of(a, tip, radius);
  }
  /// The two angles nearly cancel, and so do their slopes: those are added up over their common
  /// denominator, twice the triangle's area.
  [[nodiscard]] Slope turned(const Slope& a, const Slope& tip, const Slope& radius) const {
    const Interval cosine =
        (square(a.v) + square(tip.v) - square(radius.v)) / (Interval(2.0) * a.v * tip.v);
    const Interval area2 = a.v * tip.v * sqrt(Interval(1.0) - square(cosine));
    const Interval foot = tip.v * cosine;
    const Interval mate = per_gear * (own_ring ? -1.0 : 1.0), own = mate_ring ? 1.0 : -1.0;
    const Interval by_radius = mate * radius.v - own * (radius.v - a.v * (a.v - foot) / radius.v);
    const Interval by_tip = own * tip.v - mate * (tip.v - a.v * cosine);
    const Interval by_a = -(mate * (a.v - foot)) - own * foot;
    Slope s(turned_of(a.v, tip.v, radius.v));
    for (std::size_t i = 0; i < 3; ++i)
      s.d[i] = (by_radius * radius.d[i] + by_tip * tip.d[i] + by_a * a.d[i]) / area2;
    return s;
  }
};

/// Distance of the mate's tip corner along the circle through a place of the root, where it passes
/// (search_corner.h). None where it does not surely reach that circle.
template <class T>
std::optional<T> corner_distance(const BasicRack& rack, const EnclosedGear<T>& own,
                                 const EnclosedGear<T>& mate, const T& a, const RootPlace& place) {
  const RootPoint<T> point = root_point(rack, own, place);
  const Interval radius = range_of(point.radius), tip = range_of(mate.tip), distance = range_of(a);
  const Interval cosine =
      (square(distance) + square(tip) - square(radius)) / (Interval(2.0) * distance * tip);
  if (!(cosine.lo > -1.0 && cosine.hi < 1.0)) return std::nullopt;
  const T half = half_angle_at(mate, mate.tip);
  if (!(range_of(half).lo >= 0.0)) return std::nullopt;
  const CornerTriangle triangle{own.ring, mate.ring, static_cast<double>(mate.teeth) / own.teeth};
  return point.radius * (point.gap - abs(triangle.turned(a, mate.tip, point.radius)) -
                         half * T(triangle.per_gear));
}

}  // namespace trueflank
