// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "tests/check/check_designs.h"

// Random modified pairs for the tests of the checks.
namespace trueflank::test {

/// A pair with every kind of modification, adding material as well as removing it: external or internal,
/// spur, helical or herringbone, with little backlash, so that some of them penetrate. Throws where
/// the draw cannot be laid out; take another seed then.
inline GearTrain random_modified_pair(unsigned seed) {
  std::mt19937 engine(seed);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto count = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(engine);
  };
  const bool internal = seed % 2 == 0;
  const int pinion = count(14, 40);
  GearboxDesign design = pair_design(
      pinion, internal ? pinion + count(9, 40) : count(17, 60), internal, real(0.0, 0.08));
  design.helix_angle_rad = seed % 3 == 0 ? rad_from_deg(real(-30.0, 30.0)) : 0.0;
  design.herringbone = seed % 9 == 0;
  const GearTrain plain = laid_out(design);
  for (std::size_t g = 0; g < 2; ++g) {
    const ToothProfile& profile = plain.gears[g].profile;
    const double root = profile.root_form_radius_mm(), tip = profile.tip_form_radius_mm();
    design.gears[g].modifications = {
        .tip_relief_um = seed % 4 == 0 ? 0.0 : real(0.0, 12.0),
        .tip_relief_start_diameter_mm = 2.0 * (root + real(0.45, 0.75) * (tip - root)),
        .root_relief_um = seed % 5 == 0 ? real(0.0, 8.0) : 0.0,
        .root_relief_start_diameter_mm = 2.0 * (root + real(0.2, 0.4) * (tip - root)),
        .profile_crowning_um = real(0.0, 4.0),
        .profile_slope_um = real(-15.0, 15.0),
        .crowning_um = real(0.0, 8.0),
        .end_relief_um = real(0.0, 6.0),
        .end_relief_length_mm = real(0.5, 2.5),
        .helix_slope_um = real(-30.0, 30.0),
        .edge_chamfer_mm = seed % 3 == 1 ? real(0.05, 0.25) : 0.0,
        .tip_rounding_mm = seed % 4 == 1 ? real(0.02, 0.1) : 0.0};
  }
  return laid_out(design);
}

}  // namespace trueflank::test
