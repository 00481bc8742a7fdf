// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace trueflank {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// "Not computed": a result that does not exist. Written as null.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

[[nodiscard]] constexpr double rad_from_deg(double angle_deg) { return angle_deg * kPi / 180.0; }
[[nodiscard]] constexpr double deg_from_rad(double angle_rad) { return angle_rad * 180.0 / kPi; }
[[nodiscard]] constexpr double mm_from_um(double length_um) { return length_um * 1e-3; }
[[nodiscard]] constexpr double um_from_mm(double length_mm) { return length_mm * 1e3; }

/// Angle in [0, period).
[[nodiscard]] inline double wrapped_rad(double angle_rad, double period_rad = kTwoPi) {
  const double wrapped = angle_rad - period_rad * std::floor(angle_rad / period_rad);
  return wrapped < period_rad ? wrapped : 0.0;
}

/// Angle in [-period/2, period/2).
[[nodiscard]] inline double centred_rad(double angle_rad, double period_rad = kTwoPi) {
  return wrapped_rad(angle_rad + 0.5 * period_rad, period_rad) - 0.5 * period_rad;
}

}  // namespace trueflank
