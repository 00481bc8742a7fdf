// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trueflank {

/// Point or vector in the transverse plane [mm].
using Point2 = Eigen::Vector2d;

/// Unit vector at an angle counter-clockwise from +x.
[[nodiscard]] inline Point2 unit_vector(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}
/// The vector turned counter-clockwise about the origin.
[[nodiscard]] inline Point2 rotated(const Point2& p, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}
/// The vector turned by +90 degrees.
[[nodiscard]] inline Point2 perpendicular(const Point2& p) { return {-p.y(), p.x()}; }
[[nodiscard]] inline double cross(const Point2& a, const Point2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
[[nodiscard]] inline double polar_angle_rad(const Point2& p) { return std::atan2(p.y(), p.x()); }
/// Mirror image in the x axis.
[[nodiscard]] inline Point2 mirrored(const Point2& p) { return {p.x(), -p.y()}; }

}  // namespace trueflank
