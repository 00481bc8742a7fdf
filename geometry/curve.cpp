// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/curve.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// A contact of tool and gear in the gear's frame before it is turned by `turn_rad`.
struct Contact {
  Point2 point;
  Point2 normal;  ///< of the tool, outwards
  double turn_rad;
};

/// Not inlined: where branches for other shapes use the same angle, g++ takes sine and cosine one by one.
[[gnu::noinline]] Contact contact_of(const RackTrochoid& c, double t) {
  // Rack frame: pitch point at (r, 0), rack tooth entering towards -x, its -y corner cuts tooth 1.
  const double sin_t = std::sin(t), cos_t = std::cos(t);
  const double depth = c.corner_depth_mm + c.corner_radius_mm * sin_t;
  // The normal (stretch sin t, cos t) leads from the pitch point to the contact.
  const double lateral = depth * cos_t / (c.stretch * sin_t);
  const double rack_travel =
      c.corner_offset_mm + c.stretch * c.corner_radius_mm * cos_t - lateral;
  return {Point2(c.pitch_radius_mm - depth, -lateral), Point2(-c.stretch * sin_t, -cos_t),
          c.gap_angle_rad - rack_travel / c.pitch_radius_mm};
}

Contact contact_of(const CutterTrochoid& c, double eta) {
  const double off = eta - c.corner_centre_angle_rad;
  const double sine = c.corner_centre_radius_mm / c.cutter_pitch_radius_mm * std::sin(off);
  const double swing = std::asin(std::clamp(sine, -1.0, 1.0));
  const double cutter_angle =
      c.contact == CutterContact::kFillet ? eta - swing : eta - kPi + swing;
  const Point2 axis(c.centre_distance_mm, 0.0);
  const Point2 centre = axis + c.corner_centre_radius_mm *
                                   unit_vector(cutter_angle - c.corner_centre_angle_rad);
  const Point2 normal = unit_vector(cutter_angle - eta);
  return {centre + c.corner_radius_mm * normal, normal,
          c.gap_angle_rad - cutter_angle * c.ratio};
}

template <class Trochoid>
Point2 contact_point(const Trochoid& c, double t) {
  const Contact contact = contact_of(c, t);
  return rotated(contact.point, contact.turn_rad);
}
template <class Trochoid>
Point2 contact_tangent(const Trochoid& c, double t) {
  const Contact contact = contact_of(c, t);
  return perpendicular(rotated(contact.normal.normalized(), contact.turn_rad));
}

Point2 point_of(const CircularArc& c, double t) { return c.centre + c.radius_mm * unit_vector(t); }
Point2 point_of(const StraightLine& c, double t) { return c.start + t * c.direction; }
Point2 point_of(const Involute& c, double xi) {
  const Point2 e = unit_vector(c.base_half_angle_rad + c.sense * xi);
  return c.base_radius_mm * (e - c.sense * xi * perpendicular(e));
}
Point2 point_of(const RackTrochoid& c, double t) { return contact_point(c, t); }
Point2 point_of(const CutterTrochoid& c, double t) { return contact_point(c, t); }
Point2 point_of(const PointCurve& c, double t) { return (*c.point)(t); }

// Tangents up to sign; tangent_at orients them by the travel of the point.
Point2 tangent_of(const CircularArc&, double t) { return perpendicular(unit_vector(t)); }
Point2 tangent_of(const StraightLine& c, double) { return c.direction.normalized(); }
Point2 tangent_of(const Involute& c, double xi) {
  return unit_vector(c.base_half_angle_rad + c.sense * xi);
}
Point2 tangent_of(const RackTrochoid& c, double t) { return contact_tangent(c, t); }
Point2 tangent_of(const CutterTrochoid& c, double t) { return contact_tangent(c, t); }
Point2 tangent_of(const PointCurve& c, double t) {
  constexpr double kStep = 1e-6;  // of a roll angle or a normal's angle
  return (point_of(c, t + kStep) - point_of(c, t - kStep)).normalized();
}

}  // namespace

Point2 point_at(const Curve& curve, double parameter) {
  return std::visit([&](const auto& c) { return point_of(c, parameter); }, curve.shape);
}

Point2 Curve::start_point() const { return point_at(*this, begin); }
Point2 Curve::end_point() const { return point_at(*this, end); }

Point2 tangent_at(const Curve& curve, double parameter) {
  const Point2 t = std::visit([&](const auto& c) { return tangent_of(c, parameter); }, curve.shape);
  const double step = 1e-4 * (curve.end - curve.begin);
  const Point2 travel = point_at(curve, parameter + step) - point_at(curve, parameter - step);
  return travel.dot(t) < 0.0 ? Point2(-t) : t;
}

double chord_error_mm(const Curve& curve, double from, double to) {
  const Point2 a = point_at(curve, from);
  const Point2 chord = point_at(curve, to) - a;
  const double length = chord.norm();
  if (length == 0.0) return (point_at(curve, 0.5 * (from + to)) - a).norm();
  const Point2 across = perpendicular(chord) / length;
  const auto height = [&](double u) {
    return std::abs((point_at(curve, from + u * (to - from)) - a).dot(across));
  };
  // The height is smooth with one maximum, near the middle unless the parameter runs very unevenly:
  // parabola through three points, moved on at the same width where it points outside them. A trochoid
  // may swing across its chord: there the search starts from the highest of a few places.
  double centre = 0.5, best = height(0.5), width = 0.25;
  if (std::holds_alternative<RackTrochoid>(curve.shape) ||
      std::holds_alternative<CutterTrochoid>(curve.shape)) {
    width = 0.125;
    for (double u : {0.125, 0.25, 0.375, 0.625, 0.75, 0.875})
      if (const double h = height(u); h > best) best = h, centre = u;
  }
  for (int i = 0; i < 12 && width > 0.01; ++i) {
    const double low = height(centre - width), high = height(centre + width);
    const double curvature = low - 2.0 * best + high;
    if (curvature >= 0.0) return std::max({low, best, high});
    const double shift = 0.5 * (low - high) / curvature;
    const double bounded = std::clamp(shift, -1.0, 1.0) * width;
    centre = std::clamp(centre + bounded, width, 1.0 - width);
    best = std::max(best, height(centre));
    if (std::abs(shift) < 0.3) width *= 0.25;
    else if (std::abs(shift) < 1.0) width *= 0.5;
  }
  return best;
}

}  // namespace trueflank
