// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/gearbox_design.h"

// Random gearboxes of every kind of one stage with whatever modifications, for properties of what is
// made of them. Two stages: two_stage_designs.h.
namespace trueflank::test {

/// The next design of a seed. Teeth fit each other as far as their numbers go; whether such a set
/// can be laid out is for the caller to ask.
class RandomDesigns {
 public:
  /// kSmall: few teeth and narrow faces, so that thousands can be tried; with shaped rings, thinned teeth and bolts, too.
  enum class Size { kAny, kSmall };
  explicit RandomDesigns(std::uint64_t seed, Size size = Size::kAny) : engine_(seed), size_(size) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  int whole(int low, int high) {
    return low + static_cast<int>(between(0.0, static_cast<double>(high - low) + 0.999999));
  }
  bool chance(double share) { return between(0.0, 1.0) < share; }

  GearboxDesign next() {
    std::vector<TrainKind> kinds = train_kinds();
    std::erase_if(kinds, [](const TrainKind& kind) { return train_topology(kind.name).stage_count() > 1; });
    const TrainKind& kind =
        kinds[static_cast<std::size_t>(whole(0, static_cast<int>(kinds.size()) - 1))];
    GearboxDesign design{.name = "random"};
    design.topology = train_topology(kind.name);
    design.planets = design.topology.has_planets() ? whole(1, 4) : 1;
    design.module_mm = log_between(0.1, 6.0);
    design.backlash_mm = chance(0.5) ? between(0.0, 0.03) * design.module_mm : 0.0;
    design.layer_gap_mm = between(0.2, 2.0);
    design.rack = {.pressure_angle_rad = rad_from_deg(between(14.0, 28.0)),
                   .addendum = between(0.75, 1.1),
                   .dedendum = between(1.1, 1.4),
                   .root_radius = between(0.0, 0.4)};
    if (chance(0.5)) design.helix_angle_rad = rad_from_deg(between(-40.0, 40.0));
    design.herringbone = design.helix_angle_rad != 0.0 && chance(0.3);
    if (design.herringbone && chance(0.4)) design.relief_groove_mm = 0.3 * design.module_mm;
    for (const TopologyGear& gear : design.topology.gears)
      design.gears.push_back(next_gear(gear, design));
    for (const TopologyMesh& mesh : design.topology.meshes) fit(mesh, design);
    for (GearDesign& gear : design.gears) dress(gear, design);
    if (size_ == Size::kSmall)
      for (GearDesign& gear : design.gears) dress_further(gear, design);
    return design;
  }

 private:
  GearDesign next_gear(const TopologyGear& gear, const GearboxDesign& design) {
    const bool either = design.topology.meshes.empty() || gear.name == "wheel";
    GearDesign result{.name = gear.name};
    const bool ring = gear.name.starts_with("ring") || (either && chance(0.4));
    result.kind = ring ? GearKind::kInternal : GearKind::kExternal;
    const bool small = size_ == Size::kSmall;
    result.teeth = ring ? whole(small ? 14 : 25, small ? 40 : 90) : whole(small ? 6 : 8, small ? 16 : 45);
    if (design.topology.meshes.empty() || chance(0.5)) result.shift = between(-0.2, 0.6);
    result.face_width_mm = log_between(small ? 0.5 : 1.5, small ? 4.0 : 14.0) * design.module_mm;
    return result;
  }

  /// A ring takes the teeth that its pinion leaves it at the first mesh's centre distance.
  static void fit(const TopologyMesh& mesh, GearboxDesign& design) {
    GearDesign& one = design.gears[static_cast<std::size_t>(mesh.gear1)];
    GearDesign& two = design.gears[static_cast<std::size_t>(mesh.gear2)];
    if (two.kind != GearKind::kInternal) return;
    const GearDesign &first = design.gears.front(), &second = design.gears[1];
    if (design.topology.meshes.size() == 1)
      two.teeth = one.teeth + std::max(10, two.teeth / 2);
    else if (one.kind == GearKind::kExternal)
      two.teeth = one.teeth + first.teeth + second.teeth;
  }

  void dress(GearDesign& gear, const GearboxDesign& design) {
    const double m = design.module_mm, um = 1e3 * m;
    const double helix = std::cos(design.helix_angle_rad);
    const double pitch_mm = m * gear.teeth / helix;
    ModificationsDesign& mods = gear.modifications;
    const double x = gear.shift.value_or(0.0);
    if (chance(0.4)) {
      mods.tip_relief_um = between(0.0, 0.02) * um;
      mods.tip_relief_start_diameter_mm = gear.kind == GearKind::kExternal
                                              ? pitch_mm + 2.0 * m * (x + between(0.1, 0.5))
                                              : pitch_mm + 2.0 * m * (x - between(0.1, 0.4));
      if (chance(0.5)) mods.tip_relief_shape = ReliefShape::kLinear;
    }
    if (chance(0.4)) mods.profile_crowning_um = between(0.0, 0.015) * um;
    if (chance(0.3)) mods.profile_slope_um = between(-0.01, 0.01) * um;
    if (chance(0.4)) mods.crowning_um = between(0.0, 0.02) * um;
    if (chance(0.3)) mods.helix_slope_um = between(-0.02, 0.02) * um;
    if (chance(0.3)) {
      mods.end_relief_um = between(0.0, 0.02) * um;
      mods.end_relief_length_mm = between(0.05, 0.3) * gear.face_width_mm;
      if (chance(0.5)) mods.end_relief_shape = ReliefShape::kLinear;
    }
    if (chance(0.4)) mods.edge_chamfer_mm = between(0.02, 0.2) * m;
    if (chance(0.3)) mods.tip_rounding_mm = between(0.01, 0.1) * m;
    if (gear.kind == GearKind::kExternal && gear.name != "planet2" && chance(0.5))
      gear.bore.diameter_mm = between(0.2, 0.6) * pitch_mm;
    if (gear.kind == GearKind::kInternal && chance(0.5))
      gear.outer_diameter_mm = pitch_mm + between(5.0, 12.0) * m;
  }

  /// What next() of any size does not have, so that its designs stay those of their seeds.
  void dress_further(GearDesign& gear, const GearboxDesign& design) {
    const double m = design.module_mm, pitch_mm = m * gear.teeth / std::cos(design.helix_angle_rad);
    if (chance(0.3)) gear.thinning_mm = between(0.0, 0.1) * m;
    if (gear.kind == GearKind::kExternal) return;
    if (chance(0.4)) {
      gear.root = RingRoot::kShaper;
      gear.cutter = ShaperCutter{.teeth = std::max(5, static_cast<int>(gear.teeth * between(0.15, 0.6))),
                                 .shift = between(-0.2, 0.3),
                                 .tip_radius = between(0.0, 0.3)};
    }
    if (chance(0.3)) {
      gear.outer_diameter_mm = pitch_mm + 10.0 * m;
      gear.bolt_circle = {whole(2, 8), pitch_mm + 6.5 * m, between(0.2, 1.2) * m};
    }
  }

  std::mt19937_64 engine_;
  Size size_;
};

}  // namespace trueflank::test
