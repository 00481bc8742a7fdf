// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/gear.h"

#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {

double transverse_module_mm(const Gear& gear) {
  if (gear.helix_angle_rad == 0.0) return gear.normal_module_mm;
  return gear.normal_module_mm / std::cos(gear.helix_angle_rad);
}

double transverse_pressure_angle_rad(const Gear& gear) {
  if (gear.helix_angle_rad == 0.0) return gear.rack.pressure_angle_rad;
  return std::atan(std::tan(gear.rack.pressure_angle_rad) / std::cos(gear.helix_angle_rad));
}

double base_helix_angle_rad(const Gear& gear) {
  return std::atan(std::tan(gear.helix_angle_rad) * std::cos(transverse_pressure_angle_rad(gear)));
}

double reference_radius_mm(const Gear& gear) {
  return 0.5 * gear.teeth * transverse_module_mm(gear);
}

double base_radius_mm(const Gear& gear) {
  return reference_radius_mm(gear) * std::cos(transverse_pressure_angle_rad(gear));
}

double nominal_root_radius_mm(const Gear& gear) {
  const double m = gear.normal_module_mm;
  return gear.kind == GearKind::kExternal
             ? reference_radius_mm(gear) - m * (gear.rack.dedendum - gear.shift)
             : reference_radius_mm(gear) + m * (gear.rack.dedendum + gear.shift);
}

double nominal_tip_radius_mm(const Gear& gear) {
  const double m = gear.normal_module_mm;
  return gear.kind == GearKind::kExternal
             ? reference_radius_mm(gear) + m * (gear.rack.addendum + gear.shift)
             : reference_radius_mm(gear) - m * (gear.rack.addendum - gear.shift);
}

double base_half_angle_rad(const Gear& gear) {
  const double z = gear.teeth;
  const double sign = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  const double shift_part = 2.0 * gear.shift * std::tan(gear.rack.pressure_angle_rad) / z;
  return 0.5 * kPi / z +
         sign * (shift_part + involute_function(transverse_pressure_angle_rad(gear))) -
         0.5 * gear.thinning_mm / reference_radius_mm(gear);
}

double tooth_half_angle_rad(const Gear& gear, double radius_mm) {
  const double inv = involute_function(pressure_angle_at_radius_rad(radius_mm, base_radius_mm(gear)));
  return gear.kind == GearKind::kExternal ? base_half_angle_rad(gear) - inv
                                          : base_half_angle_rad(gear) + inv;
}

double tooth_thickness_mm(const Gear& gear, double radius_mm) {
  return 2.0 * radius_mm * tooth_half_angle_rad(gear, radius_mm);
}

}  // namespace trueflank
