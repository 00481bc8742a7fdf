// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

// Makes gears with a process the loop is not told of (measured_process.h measures them). Written apart from the library:
// flanks as unwound threads, thickness at the reference circle, normals by differences, displacements
// of points in space. Nothing here calls the library's formulas.
namespace trueflank::test {

using Vec3 = std::array<double, 3>;

struct MadeGear {
  int teeth = 24;
  double module_mm = 1.0, pressure_angle_rad = 20.0 * M_PI / 180.0, shift = 0.0;
  double face_mm = 10.0, tip_mm = 13.0, root_form_mm = 11.35;
  double helix_rad = 0.0;  ///< module_mm and the pressure angle are then transverse
  bool ring = false;

  [[nodiscard]] double reference() const { return 0.5 * module_mm * teeth; }
  [[nodiscard]] double base() const { return reference() * std::cos(pressure_angle_rad); }
};

/// A place on a flank of the gear as designed.
struct FlankSpot {
  int tooth = 1, side = 1;
  double u = 0.0;  ///< -1 root form ... +1 tip, in roll length
  double v = 0.0;  ///< -1 ... +1 over the face
};

inline double roll_of_radius(const MadeGear& g, double r) {
  return std::sqrt(r * r - g.base() * g.base());
}

/// Point by unwinding a thread: the flank through the point where the tooth is as thick as it must be.
inline Vec3 point_on(const MadeGear& g, const FlankSpot& s) {
  const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
  const double roll = from + 0.5 * (s.u + 1.0) * (to - from);
  const double z = 0.5 * (s.v + 1.0) * g.face_mm;
  const double t = roll / g.base();                       // angle unwound
  const double t_ref = std::tan(g.pressure_angle_rad);    // the same at the reference circle
  // The unwound thread starts where the flank meets the base circle; involute in its own frame.
  const auto polar = [](double a) { return a - std::atan(a); };
  const double sign = g.ring ? -1.0 : 1.0;
  const double thick = g.module_mm * (0.5 * M_PI + sign * 2.0 * g.shift * std::tan(g.pressure_angle_rad));
  const double half_at_reference = 0.5 * thick / g.reference();
  const double half = half_at_reference + sign * (polar(t_ref) - polar(t));
  const double middle = 2.0 * M_PI * (s.tooth - 1) / g.teeth + std::tan(g.helix_rad) * z / g.reference();
  const double angle = middle + s.side * half;
  const double r = std::hypot(g.base(), roll);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Outward normal by differences.
inline Vec3 normal_at(const MadeGear& g, const FlankSpot& s) {
  const double h = 1e-5;
  FlankSpot up = s, down = s, high = s, low = s;
  up.u += h;
  down.u -= h;
  high.v += h;
  low.v -= h;
  const Vec3 a1 = point_on(g, up), a0 = point_on(g, down), b1 = point_on(g, high), b0 = point_on(g, low);
  const Vec3 a{a1[0] - a0[0], a1[1] - a0[1], a1[2] - a0[2]};
  const Vec3 b{b1[0] - b0[0], b1[1] - b0[1], b1[2] - b0[2]};
  Vec3 n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  // Out of the tooth: away from its middle.
  const double middle = 2.0 * M_PI * (s.tooth - 1) / g.teeth +
                        std::tan(g.helix_rad) * 0.5 * (s.v + 1.0) * g.face_mm / g.reference();
  const double away = s.side * (-n[0] * std::sin(middle) + n[1] * std::cos(middle));
  const double f = (away >= 0.0 ? 1.0 : -1.0) / length;
  return {n[0] * f, n[1] * f, n[2] * f};
}

/// How the process moves the material at a spot: displacement in space [um], and growth along the
/// normal [um].
struct Process {
  std::function<Vec3(const MadeGear&, const FlankSpot&, const Vec3& point)> move_um;
  std::function<double(const MadeGear&, const FlankSpot&, const Vec3& point)> grow_um;
};

inline Vec3 made_point(const MadeGear& g, const FlankSpot& s, const std::vector<Process>& processes) {
  Vec3 p = point_on(g, s);
  const Vec3 nominal = p;
  const Vec3 n = normal_at(g, s);
  for (const Process& process : processes) {
    if (process.move_um) {
      const Vec3 d = process.move_um(g, s, nominal);
      for (int k = 0; k < 3; ++k) p[k] += 1e-3 * d[k];
    }
    if (process.grow_um) {
      const double d = process.grow_um(g, s, nominal);
      for (int k = 0; k < 3; ++k) p[k] += 1e-3 * d * n[k];
    }
  }
  return p;
}

/// @name Processes: each is a thing that happens to a part
/// @{
inline Process off_centre(double um, double deg) {
  const double a = deg * M_PI / 180.0;
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3&) -> Vec3 {
    return {um * std::cos(a), um * std::sin(a), 0.0};
  }};
}
inline Process leaning(double um_per_mm, double deg) {
  const double a = deg * M_PI / 180.0;
  return {.move_um = [=](const MadeGear& g, const FlankSpot&, const Vec3& p) -> Vec3 {
    const double d = um_per_mm * (p[2] - 0.5 * g.face_mm);
    return {d * std::cos(a), d * std::sin(a), 0.0};
  }};
}
/// Turned about an axis in the plane, end faces and all.
inline Process leaning_as_a_body(double um_per_mm, double deg) {
  const double a = deg * M_PI / 180.0;
  return {.move_um = [=](const MadeGear& g, const FlankSpot&, const Vec3& p) -> Vec3 {
    const double d = um_per_mm * (p[2] - 0.5 * g.face_mm);
    return {d * std::cos(a), d * std::sin(a), -um_per_mm * (p[0] * std::cos(a) + p[1] * std::sin(a))};
  }};
}
inline Process scaled(double percent) {
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    return {10.0 * percent * p[0], 10.0 * percent * p[1], 10.0 * percent * p[2]};
  }};
}
inline Process stretched(double percent, double deg) {
  const double a = deg * M_PI / 180.0;
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    // Along the axis at angle a by half the percentage, across it by minus half.
    const double along = p[0] * std::cos(a) + p[1] * std::sin(a);
    const double across = -p[0] * std::sin(a) + p[1] * std::cos(a);
    const double d = 5.0 * percent * along, e = -5.0 * percent * across;
    return {d * std::cos(a) - e * std::sin(a), d * std::sin(a) + e * std::cos(a), 0.0};
  }};
}
inline Process sheared(double percent) {
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    return {10.0 * percent * p[1], 0.0, 0.0};
  }};
}
inline Process grown(std::function<double(const MadeGear&, const FlankSpot&, const Vec3&)> um) {
  return {.grow_um = std::move(um)};
}
inline Process out_of_round(int order, double um, double deg) {
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    const double a = std::atan2(p[1], p[0]);
    const double d = um * std::cos(order * a - deg * M_PI / 180.0);
    return {d * std::cos(a), d * std::sin(a), 0.0};
  }};
}
inline Process indexed(int order, double um, double deg) {
  return {.move_um = [=](const MadeGear& g, const FlankSpot& s, const Vec3& p) -> Vec3 {
    const double theta = 2.0 * M_PI * (s.tooth - 1) / g.teeth;
    const double turn = um / g.reference() * std::cos(order * theta - deg * M_PI / 180.0);
    return {-turn * p[1], turn * p[0], 0.0};
  }};
}
inline Process shifted_above(double height_mm, double dx_um, double dy_um) {
  return {.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    return p[2] > height_mm ? Vec3{dx_um, dy_um, 0.0} : Vec3{0.0, 0.0, 0.0};
  }};
}
inline Process twisted(double um_over_face) {
  // Turn such that the flank moves by the amount along its normal from bottom to top.
  return {.move_um = [=](const MadeGear& g, const FlankSpot& s, const Vec3& p) -> Vec3 {
    const double turn = 0.5 * um_over_face * s.v / g.base();
    return {-turn * p[1], turn * p[0], 0.0};
  }};
}
/// @}

}  // namespace trueflank::test
