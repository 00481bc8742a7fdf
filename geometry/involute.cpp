// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/involute.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {

double involute_function(double angle_rad) {
  const double a2 = angle_rad * angle_rad;
  if (a2 < 1e-4) {  // tan a - a cancels; the series' next term is below 1e-17 relative
    return angle_rad * a2 *
           (1.0 / 3.0 + a2 * (2.0 / 15.0 + a2 * (17.0 / 315.0 + a2 * (62.0 / 2835.0))));
  }
  return std::tan(angle_rad) - angle_rad;
}

double inverse_involute_rad(double involute) {
  TRUEFLANK_EXPECTS(involute >= 0.0);
  if (involute == 0.0) return 0.0;
  // Newton on f(t) = t - atan t - inv with t = tan a: convex for t > 0, so it converges from above.
  double t = involute < 1.0 ? std::cbrt(3.0 * involute) * (1.0 + 0.4 * std::cbrt(involute * involute))
                            : involute + 0.5 * kPi;
  double a = std::atan(t);
  for (int i = 0; i < 60; ++i) {
    const double step = (involute_function(a) - involute) / (t * t);
    // da = f / tan^2 a; taken in the angle to keep precision near zero
    const double next = a - step;
    const double bounded = std::clamp(next, 0.5 * a, 0.5 * (a + 0.5 * kPi));
    if (bounded == a) break;
    const bool settled = std::abs(bounded - a) <= 2e-16 * a;
    a = bounded;
    t = std::tan(a);
    if (settled) break;
  }
  return a;
}

double pressure_angle_at_radius_rad(double radius_mm, double base_radius_mm) {
  if (radius_mm <= base_radius_mm) return 0.0;
  return std::atan2(roll_length_mm(radius_mm, base_radius_mm), base_radius_mm);
}

double roll_length_mm(double radius_mm, double base_radius_mm) {
  if (radius_mm <= base_radius_mm) return 0.0;
  return std::sqrt((radius_mm - base_radius_mm) * (radius_mm + base_radius_mm));
}

}  // namespace trueflank
