// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/gear.h"
#include "trueflank/geometry/point2.h"

// Numerical generation, independent of the library's formulas: a tool is a plain shape with a signed
// distance, it is rolled with the gear, and a point of the gear is where it is if the tool, over its
// whole roll, comes exactly to it and never beyond.
namespace trueflank::testing {

/// Signed distance to a convex wedge with a rounded tip corner, tooth pointing to -x, symmetric about
/// the x axis: flanks through (0, +-half_width) inclined by alpha, tip line at x = -depth. Negative
/// inside the tool. Only one corner circle of radius rho; rho = 0 is the sharp corner.
struct RackTool {
  double alpha, half_width, depth, rho;

  [[nodiscard]] double distance(Point2 p) const {
    p.y() = std::abs(p.y());
    const Point2 flank_normal(-std::sin(alpha), std::cos(alpha));
    const Point2 on_flank(0.0, half_width);
    const double to_flank = (p - on_flank).dot(flank_normal);
    const double to_tip = -depth - p.x();
    // the corner circle touches both lines from inside
    const double centre_x = -depth + rho;
    const double centre_y = half_width + centre_x * std::tan(alpha) - rho / std::cos(alpha);
    const Point2 from_centre = p - Point2(centre_x, centre_y);
    const Point2 tip_normal(-1.0, 0.0);
    // in the normal cone of the corner the circle counts, else the nearer line
    const bool in_cone =
        cross(flank_normal, from_centre) >= 0.0 && cross(from_centre, tip_normal) >= 0.0;
    if (in_cone) return from_centre.norm() - rho;
    return std::max(to_flank, to_tip);
  }
};

/// Smallest value of f over an interval, by sampling and golden section around each dip.
inline double smallest(const std::function<double(double)>& f, double low, double high,
                       int samples = 600) {
  double best = 1e300;
  const double step = (high - low) / samples;
  double before = f(low), here = f(low + step);
  for (int i = 2; i <= samples; ++i) {
    const double after = f(low + step * i);
    if (here <= before && here <= after) {
      double a = low + step * (i - 2), b = low + step * i;
      const double g = 0.5 * (std::sqrt(5.0) - 1.0);
      double c = b - g * (b - a), d = a + g * (b - a);
      double fc = f(c), fd = f(d);
      for (int k = 0; k < 80 && b - a > 1e-15; ++k) {
        if (fc < fd) {
          b = d; d = c; fd = fc; c = b - g * (b - a); fc = f(c);
        } else {
          a = c; c = d; fc = fd; d = a + g * (b - a); fd = f(d);
        }
      }
      best = std::min({best, fc, fd});
    }
    before = here;
    here = after;
  }
  return best;
}

/// Distance by which the rolling rack misses (+) or cuts (-) a point in the frame of the gear whose
/// gap's middle is on +x.
inline double rack_miss(const RackTool& rack, double pitch_radius, double shift_mm, const Point2& p,
                        double range) {
  return smallest(
      [&](double phi) {
        const Point2 q = rotated(p, phi);
        // the rack's pitch line is its reference line moved out by the shift
        return rack.distance(
            {q.x() - pitch_radius - shift_mm, q.y() - pitch_radius * phi});
      },
      -range, range, 1200);
}

/// A pinion cutter's tooth on +x: involute flanks, tip circle, rounded corner; by plain geometry.
struct PinionTool {
  double base_radius, base_half_angle, tip_radius, rho;

  [[nodiscard]] double distance(Point2 p) const {
    p.y() = std::abs(p.y());
    const double r = p.norm(), phi = std::atan2(p.y(), p.x());
    if (r <= base_radius) return 1e3;  // nothing of the tool below its base circle counts
    const double roll = std::sqrt(r * r - base_radius * base_radius);
    // normal distance to the involute along the base tangent
    const double to_flank =
        roll - base_radius * std::atan2(roll, base_radius) + base_radius * (phi - base_half_angle);
    const double to_tip = r - tip_radius;
    const double r_c = tip_radius - rho;
    const double roll_c = std::sqrt(r_c * r_c - base_radius * base_radius);
    const double inv_c = roll_c / base_radius - std::atan2(roll_c, base_radius);
    const double phi_c = base_half_angle - rho / base_radius - inv_c;
    const Point2 centre = r_c * unit_vector(phi_c);
    const Point2 flank_normal = unit_vector(phi_c + kPi / 2 - std::atan2(roll_c, base_radius));
    const Point2 from_centre = p - centre;
    const bool in_cone = cross(from_centre, flank_normal) >= 0.0 &&
                         cross(unit_vector(phi_c), from_centre) >= 0.0;
    if (in_cone) return from_centre.norm() - rho;
    return std::max(to_flank, to_tip);
  }
};

/// Centre distance without backlash of a ring (2) and its cutter (1): where the ring's space is as wide as the
/// cutter's tooth on the pitch circles. By bisection of the pressure angle.
inline double shaping_distance(double base1, double half_angle1, double base2, double half_angle2,
                               int teeth2) {
  const auto play = [&](double a_w) {
    const double i = std::tan(a_w) - a_w;
    return (kPi / teeth2 - half_angle2 - i) * base2 - (half_angle1 - i) * base1;
  };
  double low = 1e-6, high = 1.4;
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (low + high);
    (play(mid) > 0.0 ? low : high) = mid;
  }
  return (base2 - base1) / std::cos(low);
}

/// As rack_miss, for a ring shaped by a pinion cutter; the gap's middle on +x.
inline double pinion_miss(const PinionTool& tool, double centre_distance, double ratio,
                          const Point2& p, double range) {
  return smallest(
      [&](double phi) {  // cutter's angle
        const Point2 q = rotated(p, phi * ratio) - Point2(centre_distance, 0.0);
        return tool.distance(rotated(q, -phi));
      },
      -range, range, 3000);
}

}  // namespace trueflank::testing
