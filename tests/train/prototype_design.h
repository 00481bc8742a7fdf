// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/gearbox_design.h"

// Designs the tests of this folder share.
namespace trueflank::test {

/// The first prototype's teeth of Matsuki, Nagano, Fujimoto, 10.1109/TMECH.2019.2946403:
/// 12/39/90/32/81, N = 3, module 1, with the given ring shifts and centre distance.
[[nodiscard]] inline GearboxDesign prototype(double ring1_shift, double ring2_shift,
                                             double centre_distance_mm) {
  GearboxDesign design;
  design.name = "prototype";
  design.kind = TrainKind::k3k;
  design.output = OutputMember::kRing2;
  design.planets = 3;
  design.centre_distance_mm = centre_distance_mm;
  const auto add = [&](const char* name, int teeth, GearKind kind) -> GearDesign& {
    GearDesign gear;
    gear.name = name;
    gear.kind = kind;
    gear.teeth = teeth;
    design.gears.push_back(gear);
    return design.gears.back();
  };
  add("sun", 12, GearKind::kExternal);
  add("planet1", 39, GearKind::kExternal);
  add("ring1", 90, GearKind::kInternal).shift = ring1_shift;
  add("planet2", 32, GearKind::kExternal);
  add("ring2", 81, GearKind::kInternal).shift = ring2_shift;
  return design;
}

/// Any set of teeth, nothing shifted; kind and output as given.
[[nodiscard]] inline GearboxDesign unshifted(TrainKind kind, OutputMember output,
                                             const std::vector<int>& teeth) {
  GearboxDesign design;
  design.name = "test";
  design.kind = kind;
  design.output = output;
  design.planets = 3;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    GearDesign gear;
    gear.name = gear_names(kind)[i];
    gear.teeth = teeth[i];
    gear.shift = 0.0;
    if (gear.name.starts_with("ring")) gear.kind = GearKind::kInternal;
    design.gears.push_back(gear);
  }
  return design;
}

/// The paper's optimum with a bore in the sun and bolts in ring1.
[[nodiscard]] inline GearboxDesign bored_prototype() {
  GearboxDesign design = prototype(0.5225, 1.9967, 25.6826);
  design.gears[0].bore = {.diameter_mm = 5.0};
  design.gears[2].bolt_circle = {.count = 6, .circle_diameter_mm = 99.0, .hole_diameter_mm = 3.2};
  return design;
}

}  // namespace trueflank::test
