// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/tooth_span.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {

double base_tangent_length_mm(const Gear& gear, int teeth_spanned) {
  if (gear.kind == GearKind::kInternal) return kNaN;
  // (k - 1) base pitches and one base thickness, taken into the normal section.
  const double r_b = base_radius_mm(gear);
  const double transverse = (teeth_spanned - 1) * kTwoPi * r_b / gear.teeth +
                            2.0 * r_b * base_half_angle_rad(gear);
  return transverse * std::cos(base_helix_angle_rad(gear));
}

double span_face_width_mm(const Gear& gear, int teeth_spanned) {
  return base_tangent_length_mm(gear, teeth_spanned) * std::sin(std::abs(base_helix_angle_rad(gear)));
}

int recommended_span_teeth(const Gear& gear) {
  // The measured line is inclined by beta_b against the transverse section: the planes touch at the roll length
  // W cos(beta_b) / 2, chosen nearest to the circle r + x m. W itself is the transverse length times cos(beta_b).
  const double r_touch = reference_radius_mm(gear) + gear.shift * gear.normal_module_mm;
  const double r_b = base_radius_mm(gear);
  const double roll = roll_length_mm(std::max(r_touch, r_b), r_b);
  const double cosine = std::cos(base_helix_angle_rad(gear));
  const double k = (2.0 * roll / (cosine * cosine) - 2.0 * r_b * base_half_angle_rad(gear)) /
                       (kTwoPi * r_b / gear.teeth) +
                   1.0;
  return std::clamp(static_cast<int>(std::lround(k)), 1, std::max(1, gear.teeth / 2));
}

double over_pins_mm(const Gear& gear, double pin_diameter_mm) {
  const double r_b = base_radius_mm(gear);
  const double sign = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  // Centre of a pin in the gap: the parallel curve of the flank at distance d/2 passes there.
  const double pin_angle = 0.5 * pin_diameter_mm / (r_b * std::cos(base_helix_angle_rad(gear)));
  const double inv = sign * (base_half_angle_rad(gear) + pin_angle - kPi / gear.teeth);
  if (!(inv >= 0.0)) return kNaN;
  const double centre_diameter = 2.0 * r_b / std::cos(inverse_involute_rad(inv));
  const double across =
      gear.teeth % 2 == 0 ? centre_diameter : centre_diameter * std::cos(0.5 * kPi / gear.teeth);
  return across + sign * pin_diameter_mm;
}

double recommended_pin_diameter_mm(const Gear& gear) {
  // Touch on the circle r + x m: centre at the roll length of the touch (+-) d/2 on the same normal.
  const double m = gear.normal_module_mm;
  const double r_b = base_radius_mm(gear);
  const double r_touch =
      std::max(reference_radius_mm(gear) + gear.shift * m, r_b + 0.05 * m);
  const double roll = roll_length_mm(r_touch, r_b);
  const double gap_half = kPi / gear.teeth;
  const double sign = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  // On the gap's middle line: atan(L_c / r_b) - angle of the tangent point = gap middle.
  const double tangent = base_half_angle_rad(gear) - sign * roll / r_b;
  const double centre_roll = sign * r_b * std::tan(gap_half - tangent);
  const double diameter = 2.0 * sign * (centre_roll - roll) * std::cos(base_helix_angle_rad(gear));
  const double step = m >= 0.1 ? 0.05 * m : 1e-3;
  return std::max(step, std::round(diameter / step) * step);
}

}  // namespace trueflank
