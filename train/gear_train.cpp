// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solves a design in the order shifts and centre distance, thinning, tip circles, profiles, phases.
#include "trueflank/train/gear_train.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/train/flank_modifications.h"
#include "trueflank/train/planet_phase.h"
#include "trueflank/train/shift_solution.h"
#include "trueflank/train/thickness_allowance.h"

namespace trueflank {
namespace {

struct MeshNames {
  const char* gear1;
  const char* gear2;
};

std::vector<MeshNames> mesh_names(TrainKind kind) {
  switch (kind) {
    case TrainKind::k3k:
      return {{"sun", "planet1"}, {"planet1", "ring1"}, {"planet2", "ring2"}};
    case TrainKind::kSimple:
      return {{"sun", "planet"}, {"planet", "ring"}};
    case TrainKind::kPair:
      return {{"pinion", "wheel"}};
    case TrainKind::kGear:
      return {};
  }
  return {};
}

/// Helix angles follow from the first gear's: external mates have the other hand.
double helix_of(const GearboxDesign& design, const std::string& name) {
  const bool same_hand = name == "sun" || name == "pinion" || name == "gear" ||
                         (name == "wheel" && design.gears[1].kind == GearKind::kInternal);
  return same_hand ? design.helix_angle_rad : -design.helix_angle_rad;
}

std::vector<Gear> gears_without_tips(const GearboxDesign& design, const ShiftSolution& solution) {
  std::vector<Gear> gears;
  for (std::size_t i = 0; i < design.gears.size(); ++i) {
    const GearDesign& d = design.gears[i];
    Gear gear{.kind = d.kind,
              .teeth = d.teeth,
              .normal_module_mm = module_of(design, d),
              .helix_angle_rad = helix_of(design, d.name),
              .rack = design.rack,
              .shift = solution.shifts[i],
              .tip_rounding_mm = d.modifications.tip_rounding_mm,
              .ring_root = d.root,
              .cutter = d.cutter};
    gears.push_back(gear);
  }
  return gears;
}

/// Thinning of the gears that have a thickness allowance, from one end of it to the other.
Result<ThinningLimits> thinning_limits(const ThicknessAllowance& asked, const Gear& gear) {
  ThicknessAllowance allowance = asked;
  if (!asked.series.empty()) {
    auto found = din3967_allowance(asked.series, 2.0 * reference_radius_mm(gear));
    if (!found) return fail(std::move(found.error()));
    allowance = *found;
  }
  // allowances are of the normal section
  const double stretch = 1.0 / std::cos(gear.helix_angle_rad);
  return ThinningLimits{.least_mm = -allowance.upper_mm * stretch,
                        .most_mm = -allowance.lower_mm * stretch,
                        .upper_mm = allowance.upper_mm,
                        .lower_mm = allowance.lower_mm};
}

/// Backlash of a mesh with all allowances at one end; NaN where neither gear has one.
double backlash_at_limits_mm(const GearTrain& train, const TrainMesh& mesh,
                             double ThinningLimits::*end) {
  const TrainGear& gear1 = train.gears[static_cast<std::size_t>(mesh.gear1)];
  const TrainGear& gear2 = train.gears[static_cast<std::size_t>(mesh.gear2)];
  if (!gear1.thinning_limits && !gear2.thinning_limits) return kNaN;
  const GearPair pair = train.pair(mesh);
  double thinned_mm = 0.0;  // beyond what the gears have
  for (const TrainGear* gear : {&gear1, &gear2})
    if (gear->thinning_limits)
      thinned_mm += *gear->thinning_limits.*end - gear->profile.gear().thinning_mm;
  return mesh.backlash_mm + thinned_mm * pitch_radius1_mm(pair) / reference_radius_mm(pair.gear1());
}

/// Backlash by thinning: the first mesh shares it evenly, a gear already thinned keeps its part and
/// the mate takes the rest.
void share_thinning(const GearboxDesign& design, const std::vector<TrainMesh>& meshes,
                    const std::vector<std::optional<ThinningLimits>>& limits,
                    double centre_distance_mm, std::vector<Gear>& gears) {
  std::vector<bool> settled(gears.size(), false);
  for (std::size_t i = 0; i < gears.size(); ++i) {
    if (limits[i])
      gears[i].thinning_mm = 0.5 * (limits[i]->least_mm + limits[i]->most_mm);
    else if (design.gears[i].thinning_mm)
      gears[i].thinning_mm = *design.gears[i].thinning_mm;
    else
      continue;
    settled[i] = true;
  }
  for (const TrainMesh& mesh : meshes) {
    const auto i = static_cast<std::size_t>(mesh.gear1), j = static_cast<std::size_t>(mesh.gear2);
    const auto working =
        working_pressure_angle_rad(mesh_teeth(gears[i], gears[j]), centre_distance_mm);
    if (!working) continue;
    // an arc at the reference circle grows with the radius up to the working pitch circle
    const double total = design.backlash_mm * std::cos(*working) /
                         std::cos(transverse_pressure_angle_rad(gears[i]));
    if (!settled[i] && !settled[j]) {
      gears[i].thinning_mm = gears[j].thinning_mm = 0.5 * total;
    } else if (!settled[i]) {
      gears[i].thinning_mm = std::max(0.0, total - gears[j].thinning_mm);
    } else if (!settled[j]) {
      gears[j].thinning_mm = std::max(0.0, total - gears[i].thinning_mm);
    }
    settled[i] = settled[j] = true;
  }
}

void set_tip_circles(const GearboxDesign& design, const std::vector<TrainMesh>& meshes,
                     double centre_distance_mm, std::vector<Gear>& gears) {
  for (Gear& gear : gears) gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  for (const TrainMesh& mesh : meshes) {
    Gear& g1 = gears[static_cast<std::size_t>(mesh.gear1)];
    Gear& g2 = gears[static_cast<std::size_t>(mesh.gear2)];
    if (g2.kind == GearKind::kInternal) continue;
    const double m = g1.normal_module_mm;
    const double y =
        (centre_distance_mm - reference_centre_distance_mm(mesh_teeth(g1, g2))) / m;
    const double tip1 = reference_radius_mm(g1) + m * (g1.rack.addendum + y - g2.shift);
    const double tip2 = reference_radius_mm(g2) + m * (g2.rack.addendum + y - g1.shift);
    g1.tip_radius_mm = tip1;
    // a planet also meshes with a ring and takes the smaller of what both allow
    const bool planet = design.kind != TrainKind::kPair;
    g2.tip_radius_mm = planet ? std::min(tip2, g2.tip_radius_mm) : tip2;
  }
  for (std::size_t i = 0; i < gears.size(); ++i)
    if (design.gears[i].tip_diameter_mm)
      gears[i].tip_radius_mm = 0.5 * *design.gears[i].tip_diameter_mm;
}

void stack_layers(GearTrain& train) {
  double layer1 = 0.0;
  for (const TrainGear& gear : train.gears)
    if (gear.name == "planet1") layer1 = gear.face_width_mm;
  for (TrainGear& gear : train.gears) {
    if (gear.name != "planet2" && gear.name != "ring2") continue;
    gear.layer = 2;
    gear.z_lower_mm = layer1 + train.design.layer_gap_mm;
  }
}

/// Halves of opposite hands mesh only where their apexes stand at one height, and all gears of a layer
/// start at one.
Errors apex_errors(const GearboxDesign& design, const std::vector<TrainMesh>& meshes) {
  Errors errors;
  if (!design.herringbone) return errors;
  for (const TrainMesh& mesh : meshes) {
    const GearDesign& gear1 = design.gears[static_cast<std::size_t>(mesh.gear1)];
    const GearDesign& gear2 = design.gears[static_cast<std::size_t>(mesh.gear2)];
    if (gear1.face_width_mm == gear2.face_width_mm) continue;
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = mesh.name + ": herringbone teeth of different face widths have their "
                                 "apexes at different heights",
                      .key = gear2.name + ".face_width_mm",
                      .value = std::to_string(gear2.face_width_mm),
                      .remedy = "the face width of " + gear1.name + ", " +
                                std::to_string(gear1.face_width_mm)});
  }
  return errors;
}

}  // namespace

ResultAll<GearTrain> lay_out(const GearboxDesign& design) {
  TRUEFLANK_EXPECTS(design.gears.size() == gear_names(design.kind).size());
  GearTrain train;
  train.design = design;
  const auto index_of = [&](const std::string& name) {
    for (std::size_t i = 0; i < design.gears.size(); ++i)
      if (design.gears[i].name == name) return static_cast<int>(i);
    return -1;
  };
  for (const MeshNames& names : mesh_names(design.kind))
    train.meshes.push_back({.name = std::string(names.gear1) + "-" + names.gear2,
                            .gear1 = index_of(names.gear1),
                            .gear2 = index_of(names.gear2)});

  if (Errors apart = apex_errors(design, train.meshes); !apart.empty())
    return fail_all(std::move(apart));

  auto solution = solve_shifts(design, train.meshes);
  if (!solution) return fail_all(solution.error());
  train.centre_distance_mm = solution->centre_distance_mm;

  std::vector<Gear> gears = gears_without_tips(design, *solution);
  for (std::size_t k = 0; k < train.meshes.size(); ++k)
    train.meshes[k].implied_backlash_mm = solution->implied_backlash_mm[k];
  Errors errors;
  std::vector<std::optional<ThinningLimits>> limits(gears.size());
  for (std::size_t i = 0; i < gears.size(); ++i) {
    if (!design.gears[i].thickness) continue;
    auto found = thinning_limits(*design.gears[i].thickness, gears[i]);
    if (found) {
      limits[i] = *found;
    } else {
      found.error().key = design.gears[i].name + ".thickness_allowance";
      errors.push_back(std::move(found.error()));
    }
  }
  share_thinning(design, train.meshes, limits, train.centre_distance_mm, gears);
  set_tip_circles(design, train.meshes, train.centre_distance_mm, gears);

  for (std::size_t i = 0; i < gears.size(); ++i) {
    auto profile = ToothProfile::make(gears[i]);
    const GearDesign& d = design.gears[i];
    if (!profile) {
      Error error = profile.error();
      const bool of_rack = error.key.starts_with("rack.");
      if (!of_rack) error.key = d.name + "." + error.key;
      error.message = d.name + ": " + error.message;
      errors.push_back(std::move(error));
      continue;
    }
    const FaceTwist twist = face_twist(gears[i], d.face_width_mm, design.herringbone,
                                       design.relief_groove_mm);
    auto deviation = design_deviation(d.modifications, *profile, twist);
    if (!deviation) {
      for (Error& error : deviation.error()) {
        error.key = d.name + "." + error.key;
        error.message = d.name + ": " + error.message;
        errors.push_back(std::move(error));
      }
      continue;
    }
    train.gears.push_back({.name = d.name,
                           .profile = std::move(*profile),
                           .shift = gears[i].shift,
                           .face_width_mm = d.face_width_mm,
                           .twist = twist,
                           .deviation = std::move(*deviation),
                           .edge_chamfer_mm = d.modifications.edge_chamfer_mm,
                           .thinning_limits = limits[i]});
  }
  if (!errors.empty()) return fail_all(std::move(errors));

  for (TrainMesh& mesh : train.meshes)
    mesh.backlash_mm = circumferential_backlash_mm(train.pair(mesh));
  for (TrainMesh& mesh : train.meshes) {
    mesh.smallest_backlash_mm = backlash_at_limits_mm(train, mesh, &ThinningLimits::least_mm);
    mesh.largest_backlash_mm = backlash_at_limits_mm(train, mesh, &ThinningLimits::most_mm);
  }
  stack_layers(train);
  train.assembly = assembly_condition(train);
  train.phases = phases_in_mesh(train);
  return train;
}

Gear thinned(Gear gear, double thinning_mm) {
  gear.thinning_mm = thinning_mm;
  return gear;
}

const TrainGear* GearTrain::find(const std::string& name) const {
  const auto it = std::find_if(gears.begin(), gears.end(),
                               [&](const TrainGear& gear) { return gear.name == name; });
  return it == gears.end() ? nullptr : &*it;
}

Point2 wheel_centre_mm(const GearTrain& train) {
  const bool internal = train.gears.back().profile.gear().kind == GearKind::kInternal;
  return {internal ? -train.centre_distance_mm : train.centre_distance_mm, 0.0};
}

GearPair GearTrain::pair(const TrainMesh& mesh) const {
  return {.profile1 = &gears[static_cast<std::size_t>(mesh.gear1)].profile,
          .profile2 = &gears[static_cast<std::size_t>(mesh.gear2)].profile,
          .centre_distance_mm = centre_distance_mm};
}

}  // namespace trueflank
