// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/gearbox_design.h"

// Designs the tests of this folder share.
namespace trueflank::test {

/// The first prototype's teeth of Matsuki, Nagano, Fujimoto, 10.1109/TMECH.2019.2946403:
/// 12/39/90/32/81, N = 3, module 1, with the given ring shifts and centre distance.
[[nodiscard]] inline GearboxDesign prototype(double ring1_shift, double ring2_shift,
                                             double centre_distance_mm) {
  GearboxDesign design;
  design.name = "prototype";
  design.topology = train_topology("3k", "ring2");
  design.planets = 3;
  design.centre_distance_mm = centre_distance_mm;
  design.tips = TipCircles::kStandard;  // the paper's circles
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

/// Teeth of a 3k set as its table of gears has them, ring shifts and centre distance given.
[[nodiscard]] inline GearboxDesign tooth_set(const std::vector<int>& teeth,
                                             const std::vector<double>& ring_shifts,
                                             double centre_distance_mm, double friction) {
  GearboxDesign design = prototype(ring_shifts[0], ring_shifts[1], centre_distance_mm);
  for (std::size_t i = 0; i < teeth.size(); ++i) design.gears[i].teeth = teeth[i];
  design.friction = friction;
  return design;
}

/// Any set of teeth, nothing shifted; kind and output as given.
[[nodiscard]] inline GearboxDesign unshifted(const std::string& kind, const std::string& output,
                                             const std::vector<int>& teeth) {
  GearboxDesign design;
  design.name = "test";
  design.topology = train_topology(kind, output);
  design.planets = 3;
  design.tips = TipCircles::kStandard;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    GearDesign gear;
    gear.name = design.topology.gears[i].name;
    gear.teeth = teeth[i];
    gear.shift = 0.0;
    if (design.topology.gears[i].form == GearForm::kRing) gear.kind = GearKind::kInternal;
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
