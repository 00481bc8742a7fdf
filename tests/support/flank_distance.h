// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/toothing.h"
#include "trueflank/base/units.h"

// Where a point lies against the flanks of a toothing, by the equation of the involute alone.
namespace trueflank::test {

/// Normal deviation [mm] that a flank should have; arguments as FlankDeviation::deviation_mm.
using WantedDeviation = std::function<double(int tooth, Flank flank, double roll_mm, double z_mm)>;

/// Distance of a point of a flank from the involute helicoid, moved by the deviation wanted there
/// and by a chamfer, along the transverse normal [mm].
/// The involute through the point is the design's turned by d / r_b; the point that became it stood
/// d before it on the normal.
inline double flank_error_mm(const Toothing& toothing, const std::array<double, 3>& p,
                             const WantedDeviation& wanted = {}) {
  const Gear& gear = toothing.profile->gear();
  const double r_b = base_radius_mm(gear), pitch = kTwoPi / gear.teeth;
  const int sense = gear.kind == GearKind::kExternal ? -1 : 1;
  const Point2 section = rotated({p[0], p[1]}, -section_turn_rad(toothing.twist, p[2]));
  const double tooth_turns = std::round(polar_angle_rad(section) / pitch);
  const double angle = polar_angle_rad(rotated(section, -tooth_turns * pitch));
  const double r = section.norm();
  const double design = base_half_angle_rad(gear) +
                        sense * involute_function(pressure_angle_at_radius_rad(r, r_b));
  const double moved = (std::abs(angle) - design) * r_b;
  double expected = 0.0;
  if (wanted) {
    const int side = angle > 0.0 ? 1 : -1;
    const Flank flank = flank_side(Flank::kLeft, gear.kind) == side ? Flank::kLeft : Flank::kRight;
    const int tooth = (static_cast<int>(tooth_turns) + gear.teeth) % gear.teeth;
    expected = wanted(tooth, flank, roll_length_mm(r, r_b) + sense * moved, p[2]) /
               std::cos(base_helix_angle_rad(gear));
  }
  const double from_end = std::min(p[2], toothing.twist.face_width_mm - p[2]);
  expected -= std::max(0.0, toothing.edge_chamfer_mm - std::max(0.0, from_end));
  return std::abs(moved - expected);
}

/// Area of a toothing's section at a height: a polygon of many points of the section, refined by
/// Richardson's rule.
inline double section_area_mm2(const Toothing& toothing, double z_mm) {
  const auto& pieces = toothing.profile->pieces();
  const int teeth = toothing.profile->gear().teeth;
  const auto polygon = [&](int steps) {
    double sum = 0.0;
    std::array<Point2, 2> ends;
    for (int tooth = 0; tooth < teeth; ++tooth) {
      for (const int side : {1, -1}) {
        Point2 last = Point2::Zero();
        for (std::size_t i = 0; i < pieces.size(); ++i)
          for (int k = i == 0 ? 0 : 1; k <= steps; ++k) {
            const double u = static_cast<double>(k) / steps;
            const Curve& c = pieces[i].curve;
            const Point2 p = section_point(
                toothing, {tooth, side, i, c.begin + u * (c.end - c.begin)}, z_mm);
            if (i != 0 || k != 0) sum += 0.5 * side * cross(last, p);
            last = p;
          }
      }
      if (!(toothing.has_deviation() && toothing.deviation->varies_by_tooth)) return teeth * sum;
    }
    return sum;
  };
  const double coarse = polygon(120), fine = polygon(240);
  return fine + (fine - coarse) / 3.0;
}

/// The volume between two heights, by Simpson's rule on each band between breaks.
inline double toothing_volume_mm3(const Toothing& toothing, std::vector<double> breaks_mm) {
  breaks_mm.insert(breaks_mm.end(), {0.0, toothing.twist.face_width_mm});
  std::sort(breaks_mm.begin(), breaks_mm.end());
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < breaks_mm.size(); ++i) {
    constexpr int kSteps = 16;
    const double step = (breaks_mm[i + 1] - breaks_mm[i]) / kSteps;
    for (int k = 0; k <= kSteps; ++k)
      volume += (k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * step / 3.0 *
                section_area_mm2(toothing, breaks_mm[i] + k * step);
  }
  return volume;
}

/// Lead crowning and tip relief that starts with a bend, and end relief over 1.5 mm.
inline FlankDeviation sample_modifications(const Gear& gear, double face_width_mm,
                                           double relief_start_roll_mm, double crowning_mm = 0.008) {
  const double sense = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  constexpr double kEnd_mm = 1.5;
  FlankDeviation d;
  d.deviation_mm = [=](int, Flank flank, double roll_mm, double z_mm) {
    const double x = 2.0 * z_mm / face_width_mm - 1.0;
    const double into = std::max(0.0, sense * (roll_mm - relief_start_roll_mm));
    const double end = std::max(0.0, kEnd_mm - std::min(z_mm, face_width_mm - z_mm)) / kEnd_mm;
    return -crowning_mm * x * x - 0.012 * into - 0.004 * end * end -
           (flank == Flank::kLeft ? 0.003 : 0.0);
  };
  d.varies_along_face = true;
  d.roll_breaks_mm = {relief_start_roll_mm};
  d.z_breaks_mm = {kEnd_mm, face_width_mm - kEnd_mm};
  return d;
}

}  // namespace trueflank::test
