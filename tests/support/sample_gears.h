// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"

// Gears with every shape of tooth that a profile can have.
namespace trueflank::test {

/// What a failing test says of a gear whose parameters were drawn.
inline std::string described(const Gear& g) {
  const BasicRack& rack = g.rack;
  return "z " + std::to_string(g.teeth) + " beta " + std::to_string(deg_from_rad(g.helix_angle_rad)) + " x " +
         std::to_string(g.shift) + " m " + std::to_string(g.normal_module_mm) + " alpha " +
         std::to_string(deg_from_rad(rack.pressure_angle_rad)) + " hf " + std::to_string(rack.dedendum) + " rho " +
         std::to_string(rack.root_radius) + " pr " + std::to_string(rack.protuberance) + " at " +
         std::to_string(deg_from_rad(rack.protuberance_angle_rad)) + " q " + std::to_string(rack.grinding_stock) +
         " thin " + std::to_string(g.thinning_mm) + " tip " + std::to_string(g.tip_radius_mm) +
         (g.cutter ? " cutter z " + std::to_string(g.cutter->teeth) + " x " + std::to_string(g.cutter->shift) + " rho " +
                         std::to_string(g.cutter->tip_radius)
                   : std::string());
}

/// Of a gear that a test takes to have teeth; throws what is wrong where it has none.
inline ToothProfile profile_of(const Gear& gear) {
  auto profile = ToothProfile::make(gear);
  if (!profile) throw std::runtime_error(profile.error().message);
  return std::move(*profile);
}

struct SampleGear {
  std::string name;
  Gear gear;
};

inline Gear external_gear(int teeth, double shift, double module_mm = 1.0) {
  Gear gear;
  gear.teeth = teeth;
  gear.shift = shift;
  gear.normal_module_mm = module_mm;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

inline Gear ring_gear(int teeth, double shift) {
  Gear gear;
  gear.kind = GearKind::kInternal;
  gear.teeth = teeth;
  gear.shift = shift;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

inline Gear shaped_ring(int teeth, double shift, ShaperCutter cutter) {
  Gear gear = ring_gear(teeth, shift);
  gear.ring_root = RingRoot::kShaper;
  gear.cutter = cutter;
  return gear;
}

inline Gear with_root_radius(Gear gear, double root_radius) {
  gear.rack.root_radius = root_radius;
  return gear;
}

/// Normal module 1; teeth, shift and hand as given.
inline Gear helical_gear(int teeth, double shift, double helix_rad) {
  Gear gear;
  gear.teeth = teeth;
  gear.shift = shift;
  gear.helix_angle_rad = helix_rad;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

inline Gear helical_ring(int teeth, double shift, double helix_rad) {
  Gear gear = ring_gear(teeth, shift);
  gear.helix_angle_rad = helix_rad;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

inline Gear with_tip_rounding(Gear gear, double radius_mm) {
  gear.tip_rounding_mm = radius_mm;
  return gear;
}

inline std::vector<SampleGear> sample_gears() {
  Gear odd_angle = external_gear(24, 0.1, 2.5);
  odd_angle.rack.pressure_angle_rad = 0.25;
  Gear thinned = external_gear(39, 0.3);
  thinned.thinning_mm = 0.03;
  return {
      {"planet of 39 teeth", external_gear(39, 0.3)},
      {"thinned planet", thinned},
      {"5 teeth", external_gear(5, 0.6)},
      {"undercut pinion of 8 teeth", external_gear(8, 0.0)},
      {"pointed teeth", external_gear(9, 1.0)},
      {"sharp rack", with_root_radius(external_gear(20, 0.0), 0.0)},
      {"sharp rack, undercut", with_root_radius(external_gear(8, 0.1), 0.0)},
      {"full round root", with_root_radius(external_gear(20, 0.0), 1.0)},
      {"odd pressure angle", odd_angle},
      {"module 10", external_gear(30, 0.0, 10.0)},
      {"module 0.1", external_gear(30, 0.0, 0.1)},
      {"200 teeth", external_gear(200, 0.0)},
      {"ring of 81 teeth", ring_gear(81, 1.9967)},
      {"ring with full round roots", with_root_radius(ring_gear(60, 0.0), 1.0)},
      {"ring with sharp roots", with_root_radius(ring_gear(60, 0.0), 0.0)},
      {"ring, tip inside the base circle", ring_gear(20, 0.0)},
      {"shaped ring", shaped_ring(90, 0.5, {25, 0.0, 0.2})},
      {"shaped ring, sharp cutter", shaped_ring(40, 0.0, {25, 0.0, 0.0})},
      {"shaped ring, full round cutter", shaped_ring(60, 0.0, {25, 0.0, 0.5})},
      {"rounded tips", with_tip_rounding(external_gear(24, 0.1), 0.15)},
      {"ring with rounded tips", with_tip_rounding(ring_gear(60, 0.2), 0.12)},
      {"ring trimmed by its cutter", shaped_ring(36, 0.0, {30, 0.0, 0.2})},
  };
}

}  // namespace trueflank::test
