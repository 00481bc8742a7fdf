// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include "trueflank/base/units.h"

// The foot of a point on the nearest involute, written once for one point and for four at once:
// `Of::Value` is a number or four of them, and `Of` has what differs. The same digits of both.
namespace trueflank::loop {

/// What a gear's flanks are for this.
struct ToothedCylinder {
  int teeth = 0;
  double sense = 1.0, base_radius = 0.0, half_angle = 0.0;
  double face_width = 0.0, twist_per_mm = 0.0, cos_base_helix = 1.0, sin_base_helix = 0.0;
  bool herringbone = false;
};

/// Below this series for angles tell as many digits as the functions: the next term is less than
/// 1e-17 of the first.
inline constexpr double kSmallAngle = 0.01;

/// `Of` for one point.
struct OneAtATime {
  using Value = double;
  static double where(bool is, double a, double b) { return is ? a : b; }
  static double square_root(double x) { return std::sqrt(x); }
  static double arc_tangent(double x) { return std::atan(x); }
  static double arc_tangent(double y, double x) { return std::atan2(y, x); }
  static double arc_tangent_unless(bool is_near, double a, double near) {
    return is_near ? near : std::atan(a);
  }
  static double nearest_number(double x) { return std::round(x); }
  /// A whole number as one from 0 to teeth - 1.
  static double wrapped(double number, int teeth) {
    const int tooth = static_cast<int>(number) % teeth;
    return tooth < 0 ? tooth + teeth : tooth;
  }
  static double within_half_a_turn(double turn) {
    return std::abs(turn) <= kPi ? turn : std::remainder(turn, kTwoPi);
  }
};

template <class Of>
struct Foot {
  using Value = typename Of::Value;
  Value tooth{}, side{};          ///< 0-based; +1 or -1
  Value radius{}, polar{};        ///< of the point
  Value roll{}, z{}, distance{};  ///< of the place; how far the point stands off the involute
  Value place_radius{}, place_polar{}, normal{};
  Value turn{};  ///< from the point to the place, within -pi and pi
  /// Directions of the point, of the place and of its normal; the last two by series, where the
  /// turn is below kSmallAngle.
  std::array<Value, 2> from{}, to{}, normal_direction{};
};

/// Rotation of the section at a height.
template <class Of>
[[gnu::always_inline]] inline typename Of::Value twist_at(const ToothedCylinder& g,
                                                          const typename Of::Value& z) {
  const typename Of::Value plain = g.twist_per_mm * z;
  if (!g.herringbone) return plain;
  return Of::where(z > 0.5 * g.face_width, g.twist_per_mm * (g.face_width - z), plain);
}

/// The arc tangent of (a - b) / (1 + a b) on top of that of b: that of a, where they are near.
template <class Of>
[[gnu::always_inline]] inline typename Of::Value arc_tangent_near(
    const typename Of::Value& a, const typename Of::Value& b,
    const typename Of::Value& arc_tangent_of_b) {
  using Value = typename Of::Value;
  const Value t = (a - b) / (1.0 + a * b), s = t * t;
  const Value near =
      arc_tangent_of_b + t * (1.0 - s * (1.0 / 3.0 - s * (0.2 - s * (1.0 / 7.0 - s / 9.0))));
  return Of::arc_tangent_unless(s < kSmallAngle * kSmallAngle, a, near);
}

/// A direction turned by a small angle.
template <class Of>
[[gnu::always_inline]] inline std::array<typename Of::Value, 2> turned(
    const std::array<typename Of::Value, 2>& direction, const typename Of::Value& angle_rad) {
  using Value = typename Of::Value;
  const Value s = angle_rad * angle_rad;
  const Value cosine = 1.0 - s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s / 40320.0)));
  const Value sine =
      angle_rad * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s / 362880.0))));
  return {direction[0] * cosine - direction[1] * sine, direction[0] * sine + direction[1] * cosine};
}

/// Direction of the normal, from that of the place. It stands to the direction of the place as the
/// tangent of the base circle stands to the radius: by the angle whose cosine is base radius over
/// radius, short of a right angle.
template <class Of>
[[gnu::always_inline]] inline std::array<typename Of::Value, 2> normal_at(
    const ToothedCylinder& g, const std::array<typename Of::Value, 2>& to,
    const typename Of::Value& roll, const typename Of::Value& side,
    const typename Of::Value& radius) {
  using Value = typename Of::Value;
  const Value along = g.sense * roll / radius, across = side * g.base_radius / radius;
  return {to[0] * along - to[1] * across, to[0] * across + to[1] * along};
}

/// A place on a flank, but for its directions. The pressure angle is the arc tangent of the roll
/// length over the base radius.
template <class Of>
[[gnu::always_inline]] inline void set_place(const ToothedCylinder& g,
                                             const typename Of::Value& pressure_rad,
                                             Foot<Of>& foot) {
  using Value = typename Of::Value;
  const Value xi = foot.roll / g.base_radius;
  const Value inv = xi - pressure_rad;
  const Value centre = kTwoPi * foot.tooth / static_cast<double>(g.teeth) + twist_at<Of>(g, foot.z);
  foot.place_radius = Of::square_root(g.base_radius * g.base_radius + foot.roll * foot.roll);
  foot.place_polar = centre + foot.side * (g.half_angle - g.sense * inv);
  foot.normal = centre + foot.side * (0.5 * kPi + g.half_angle - g.sense * xi);
}

/// Of a point outside the base circle; of one inside, only the tooth says something.
template <class Of>
[[gnu::always_inline]] inline Foot<Of> foot_of(const ToothedCylinder& g,
                                               const typename Of::Value& x,
                                               const typename Of::Value& y,
                                               const typename Of::Value& z) {
  using Value = typename Of::Value;
  Foot<Of> foot;
  foot.radius = Of::square_root(x * x + y * y);
  foot.polar = Of::arc_tangent(y, x);
  const double pitch = kTwoPi / g.teeth;
  const Value from_first = foot.polar - twist_at<Of>(g, z);
  const Value number = Of::nearest_number(from_first / pitch);
  const Value offset = from_first - number * pitch;
  foot.tooth = Of::wrapped(number, g.teeth);
  foot.side = Of::where(offset >= 0.0, Value{} + 1.0, Value{} - 1.0);
  const Value outside =
      Of::where(foot.radius > g.base_radius, foot.radius, Value{} + g.base_radius);
  const Value roll = Of::square_root((outside - g.base_radius) * (outside + g.base_radius));
  const Value pressure = Of::arc_tangent(roll / g.base_radius);  // of the point
  const Value involute = roll - g.base_radius * pressure;
  const Value transverse = g.base_radius * (foot.side * offset - g.half_angle) + g.sense * involute;
  // The foot of the normal: on a helical flank it stands at another height than the point.
  foot.distance = transverse * g.cos_base_helix;
  const Value below = roll - g.sense * foot.distance * g.cos_base_helix;
  foot.roll = Of::where(0.0 < below, below, Value{});
  Value hand = Value{} + 1.0;
  if (g.herringbone) hand = Of::where(z > 0.5 * g.face_width, Value{} - 1.0, hand);
  foot.z = z + foot.distance * hand * foot.side * g.sin_base_helix;
  set_place<Of>(g, arc_tangent_near<Of>(foot.roll / g.base_radius, roll / g.base_radius, pressure),
                foot);
  foot.from = {x / foot.radius, y / foot.radius};
  // within two turns, but for flanks twisted further
  const Value turn = foot.place_polar - foot.polar;
  foot.turn = Of::within_half_a_turn(Of::where(turn > kPi, turn - kTwoPi, turn));
  foot.to = turned<Of>(foot.from, foot.turn);
  foot.normal_direction = normal_at<Of>(g, foot.to, foot.roll, foot.side, foot.place_radius);
  return foot;
}

}  // namespace trueflank::loop
