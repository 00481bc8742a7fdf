// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solves a design in the order shifts and centre distance, thinning, tip circles, profiles, phases.
#include "trueflank/train/gear_train.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/train/clear_tips.h"
#include "trueflank/train/flank_modifications.h"
#include "trueflank/train/planet_phase.h"
#include "trueflank/train/shift_solution.h"
#include "trueflank/train/stages.h"
#include "trueflank/train/thickness_allowance.h"

namespace trueflank {
namespace {

/// Helix angles follow from the first gear's: gears of one body have one hand, a ring has its mate's,
/// external mates have opposite ones.
std::vector<double> helix_angles(const GearboxDesign& design) {
  const Topology& topology = design.topology;
  std::vector<double> angles(design.gears.size(), kNaN);
  if (!angles.empty()) angles[0] = design.helix_angle_rad;
  for (bool changed = true; changed;) {
    changed = false;
    const auto settle = [&](int from, int to, bool same_hand) {
      const double known = angles[static_cast<std::size_t>(from)];
      double& angle = angles[static_cast<std::size_t>(to)];
      if (std::isnan(known) || !std::isnan(angle)) return;
      angle = same_hand ? known : -known;
      changed = true;
    };
    for (const TopologyMesh& mesh : topology.meshes) {
      const bool internal = design.gears[static_cast<std::size_t>(mesh.gear2)].kind == GearKind::kInternal;
      settle(mesh.gear1, mesh.gear2, internal);
      settle(mesh.gear2, mesh.gear1, internal);
    }
    for (std::size_t i = 0; i < topology.gears.size(); ++i)
      for (std::size_t j = 0; j < topology.gears.size(); ++j)
        if (topology.gears[i].member == topology.gears[j].member)
          settle(static_cast<int>(i), static_cast<int>(j), true);
  }
  for (double& angle : angles)
    if (std::isnan(angle)) angle = design.helix_angle_rad;
  return angles;
}

std::vector<Gear> gears_without_tips(const GearboxDesign& design, const ShiftSolution& solution) {
  std::vector<Gear> gears;
  const std::vector<double> helix = helix_angles(design);
  for (std::size_t i = 0; i < design.gears.size(); ++i) {
    const GearDesign& d = design.gears[i];
    Gear gear{.kind = d.kind,
              .teeth = d.teeth,
              .normal_module_mm = module_of(design, d),
              .helix_angle_rad = helix[i],
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
    // a planet that also meshes with a ring takes the smaller of what both allow
    const bool in_a_ring = std::any_of(meshes.begin(), meshes.end(), [&](const TrainMesh& other) {
      return other.gear1 == mesh.gear2 &&
             gears[static_cast<std::size_t>(other.gear2)].kind == GearKind::kInternal;
    });
    g2.tip_radius_mm = in_a_ring ? std::min(tip2, g2.tip_radius_mm) : tip2;
  }
  for (std::size_t i = 0; i < gears.size(); ++i)
    if (design.gears[i].tip_diameter_mm)
      gears[i].tip_radius_mm = 0.5 * *design.gears[i].tip_diameter_mm;
}

/// A layer is as high as its planets, or as its highest gear where it has none.
double height_of_layer_mm(const GearTrain& train, int layer) {
  double of_planets = 0.0, of_all = 0.0;
  for (std::size_t i = 0; i < train.gears.size(); ++i) {
    const TrainGear& gear = train.gears[i];
    if (gear.layer != layer) continue;
    of_all = std::max(of_all, gear.face_width_mm);
    if (train.topology().is_planet_gear(i)) of_planets = std::max(of_planets, gear.face_width_mm);
  }
  return of_planets > 0.0 ? of_planets : of_all;
}

void stack_layers(GearTrain& train) {
  int top = 1;
  for (std::size_t i = 0; i < train.gears.size(); ++i)
    top = std::max(top, train.gears[i].layer = train.topology().gears[i].layer);
  double floor = 0.0;
  for (int layer = 2; layer <= top; ++layer) {
    floor += height_of_layer_mm(train, layer - 1) + train.design.layer_gap_mm;
    for (TrainGear& gear : train.gears)
      if (gear.layer == layer) gear.z_lower_mm = floor;
  }
}

/// Gears that are not those of the topology, in its order.
Errors gear_errors(const GearboxDesign& design) {
  std::string wanted;
  bool alike = design.gears.size() == design.topology.gears.size();
  for (std::size_t i = 0; i < design.topology.gears.size(); ++i) {
    const TopologyGear& place = design.topology.gears[i];
    wanted += (wanted.empty() ? "" : ", ") + place.name;
    if (!alike) continue;
    const GearDesign& gear = design.gears[i];
    const bool ring = gear.kind == GearKind::kInternal;
    alike = gear.name == place.name && (place.form == GearForm::kEither || ring == (place.form == GearForm::kRing));
  }
  if (alike) return {};
  return {{.code = ErrorCode::kInconsistent,
           .message = "the gears of the design are not those of its kind, \"" + design.topology.kind + "\"",
           .key = "gearbox.kind",
           .remedy = "the gears " + wanted + ", in this order"}};
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
                      .value = trimmed_number(gear2.face_width_mm),
                      .remedy = "the face width of " + gear1.name + ", " +
                                trimmed_number(gear1.face_width_mm)});
  }
  return errors;
}

/// Gears whose shifts the centre distance asks for and that cannot be made so: that is the cause, and not keys
/// nobody has written.
Error centre_distance_error(const GearboxDesign& design, const std::vector<TrainMesh>& meshes,
                            const std::vector<Gear>& gears, const std::vector<std::size_t>& impossible) {
  std::string shifts;
  for (const std::size_t i : impossible)
    shifts += (shifts.empty() ? "" : ", ") + design.gears[i].name + " " + printed_number(gears[i].shift, "%.6g");
  std::string unshifted;
  for (const TrainMesh& mesh : meshes) {
    const double a = reference_centre_distance_mm(mesh_teeth(gears[static_cast<std::size_t>(mesh.gear1)],
                                                             gears[static_cast<std::size_t>(mesh.gear2)]));
    unshifted += (unshifted.empty() ? "" : ", ") + mesh.name + " " + printed_number(a, "%.6g") + " mm";
  }
  return {.code = ErrorCode::kInfeasible,
          .message = "no teeth fit this centre distance: it asks for profile shifts of " + shifts,
          .key = "gearbox.centre_distance_mm",
          .value = printed_number(*design.centre_distance_mm, "%.6g"),
          .remedy = "near that of the teeth without shifts: " + unshifted};
}

/// Of the gears whose tooth thickness has an allowance.
struct AllThinningLimits {
  std::vector<std::optional<ThinningLimits>> limits;
  Errors errors;
};
AllThinningLimits all_thinning_limits(const GearboxDesign& design, const std::vector<Gear>& gears) {
  AllThinningLimits all{.limits = std::vector<std::optional<ThinningLimits>>(gears.size()), .errors = {}};
  for (std::size_t i = 0; i < gears.size(); ++i) {
    if (!design.gears[i].thickness) continue;
    auto found = thinning_limits(*design.gears[i].thickness, gears[i]);
    if (found) {
      all.limits[i] = *found;
    } else {
      found.error().key = design.gears[i].name + ".thickness_allowance";
      all.errors.push_back(std::move(found.error()));
    }
  }
  return all;
}

/// Teeth that cannot be made because of what the file does not say itself: the shift or the tip that the centre
/// distance asks for.
bool follows_from_centre_distance(const Error& error, const GearboxDesign& design, const GearDesign& gear) {
  const bool unwritten = error.key == "shift" || error.key == "teeth" ||
                         (error.key == "tip_diameter_mm" && !gear.tip_diameter_mm);
  const bool of_the_teeth = error.code == ErrorCode::kInfeasible || error.key == "tip_diameter_mm";
  return of_the_teeth && unwritten && !gear.shift && design.centre_distance_mm;
}

Error of_gear(Error error, const GearDesign& gear) {
  error.message = gear.name + ": " + error.message;
  if (!error.key.starts_with("rack.")) error.key = gear.name + "." + error.key;  // the rack is everybody's
  return error;
}

Error profile_error(Error error, const GearDesign& gear) {
  if (error.key == "tip_diameter_mm" && !gear.tip_diameter_mm && gear.cutter) {
    error.message += ", and its tip circle of diameter " + error.value + " mm lies inside that";
    error.key = "cutter.teeth";
    error.value = std::to_string(gear.cutter->teeth);
  }
  return of_gear(std::move(error), gear);
}

/// All gears with their profiles and modifications. Errors: theirs, after those of the thinning.
ResultAll<std::vector<TrainGear>> made_gears(const GearTrain& train, const std::vector<Gear>& gears,
                                             const AllThinningLimits& thinning,
                                             const std::vector<double>& shortened_mm) {
  const GearboxDesign& design = train.design;
  std::vector<TrainGear> made;
  std::vector<std::size_t> impossible;
  Errors errors = thinning.errors;
  for (std::size_t i = 0; i < gears.size(); ++i) {
    const GearDesign& d = design.gears[i];
    auto profile = ToothProfile::make(gears[i]);
    if (!profile && follows_from_centre_distance(profile.error(), design, d)) {
      impossible.push_back(i);
      continue;
    }
    if (!profile) {
      errors.push_back(profile_error(std::move(profile.error()), d));
      continue;
    }
    const FaceTwist twist = face_twist(gears[i], d.face_width_mm, design.herringbone, design.relief_groove_mm);
    auto deviation = design_deviation(d.modifications, *profile, twist);
    if (!deviation) {
      for (Error& error : deviation.error()) errors.push_back(of_gear(std::move(error), d));
      continue;
    }
    made.push_back({.name = d.name,
                    .profile = std::move(*profile),
                    .shift = gears[i].shift,
                    .face_width_mm = d.face_width_mm,
                    .twist = twist,
                    .deviation = std::move(*deviation),
                    .edge_chamfer_mm = d.modifications.edge_chamfer_mm,
                    .tip_shortened_mm = shortened_mm[i],
                    .thinning_limits = thinning.limits[i]});
  }
  if (!impossible.empty()) errors.push_back(centre_distance_error(design, train.meshes, gears, impossible));
  if (!errors.empty()) return fail_all(std::move(errors));
  return made;
}

}  // namespace

ResultAll<GearTrain> lay_out(const GearboxDesign& design) {
  auto train = lay_out_teeth(design);
  if (!train || !train->stages.empty()) return train;
  train->speeds = member_speeds(design.topology, signed_teeth(design));
  train->assembly = assembly_condition(*train);
  train->phases = phases_in_mesh(*train);
  return train;
}

ResultAll<GearTrain> lay_out_teeth(const GearboxDesign& design) {
  if (Errors wrong = gear_errors(design); !wrong.empty()) return fail_all(std::move(wrong));
  if (design.topology.stage_count() > 1) return lay_out_stages(design);
  GearTrain train;
  train.design = design;
  for (const TopologyMesh& mesh : design.topology.meshes)
    train.meshes.push_back(
        {.name = design.topology.mesh_name(mesh), .gear1 = mesh.gear1, .gear2 = mesh.gear2});

  if (Errors apart = apex_errors(design, train.meshes); !apart.empty())
    return fail_all(std::move(apart));

  auto solution = solve_shifts(design, train.meshes);
  if (!solution) return fail_all(solution.error());
  train.centre_distance_mm = solution->centre_distance_mm;
  for (TrainMesh& mesh : train.meshes) mesh.centre_distance_mm = train.centre_distance_mm;

  std::vector<Gear> gears = gears_without_tips(design, *solution);
  for (std::size_t k = 0; k < train.meshes.size(); ++k)
    train.meshes[k].implied_backlash_mm = solution->implied_backlash_mm[k];
  const AllThinningLimits thinning = all_thinning_limits(design, gears);
  share_thinning(design, train.meshes, thinning.limits, train.centre_distance_mm, gears);
  set_tip_circles(design, train.meshes, train.centre_distance_mm, gears);
  std::vector<double> shortened_mm(gears.size(), 0.0);
  if (design.tips == TipCircles::kClear)
    shortened_mm = clear_tips(design, train.meshes, train.centre_distance_mm, gears);
  auto made = made_gears(train, gears, thinning, shortened_mm);
  if (!made) return fail_all(std::move(made.error()));
  train.gears = std::move(*made);

  for (TrainMesh& mesh : train.meshes)
    mesh.backlash_mm = circumferential_backlash_mm(train.pair(mesh));
  for (TrainMesh& mesh : train.meshes) {
    mesh.smallest_backlash_mm = backlash_at_limits_mm(train, mesh, &ThinningLimits::least_mm);
    mesh.largest_backlash_mm = backlash_at_limits_mm(train, mesh, &ThinningLimits::most_mm);
  }
  stack_layers(train);
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

const TrainGear* GearTrain::sun() const {
  for (const TopologyMesh& mesh : topology().meshes)
    for (const auto& [own, other] : {std::pair(mesh.gear1, mesh.gear2), std::pair(mesh.gear2, mesh.gear1)})
      if (gear(own).profile.gear().kind == GearKind::kExternal &&
          !topology().is_planet_gear(static_cast<std::size_t>(own)) &&
          topology().is_planet_gear(static_cast<std::size_t>(other)))
        return &gear(own);
  return nullptr;
}

Point2 axis_centre_mm(const GearTrain& train, const AssemblyPhases& phases, int member,
                      std::size_t place) {
  const Topology& topology = train.topology();
  if (topology.is_planet(member))
    return train.axis_distance_mm(member) * unit_vector(phases.positions_rad(member)[place]);
  if (topology.members[static_cast<std::size_t>(member)].axis == 0) return Point2::Zero();
  const bool internal =
      train.gear(topology.first_gear_of(member)).profile.gear().kind == GearKind::kInternal;
  return {internal ? -train.centre_distance_mm : train.centre_distance_mm, 0.0};
}

AssemblyPhases turned(const GearTrain& train, double input_turn_rad) {
  AssemblyPhases phases = train.phases;
  const Topology& topology = train.topology();
  for (std::size_t m = 0; m < topology.members.size(); ++m)
    for (double& rotation : phases.member_rotation_rad[m]) rotation += train.speeds.of[m] * input_turn_rad;
  for (std::size_t m = 0; m < topology.members.size(); ++m)
    for (double& position : phases.position_rad[m])
      position += train.speeds.of_arm(topology.carrier_of(static_cast<int>(m))) * input_turn_rad;
  return phases;
}

BodyMotion motion_of(const GearTrain& train, int member) {
  if (member == kNoMember) return {};
  const Topology& topology = train.topology();
  BodyMotion motion{.turn = train.speeds.of[static_cast<std::size_t>(member)]};
  motion.orbit = topology.is_carrier(member) ? motion.turn
                                             : train.speeds.of_arm(topology.carrier_of(member));
  return motion;
}

GearPair GearTrain::pair(const TrainMesh& mesh) const {
  return {.profile1 = &gears[static_cast<std::size_t>(mesh.gear1)].profile,
          .profile2 = &gears[static_cast<std::size_t>(mesh.gear2)].profile,
          .centre_distance_mm = mesh.centre_distance_mm};
}

double GearTrain::axis_distance_mm(int member) const {
  if (topology().members[static_cast<std::size_t>(member)].axis == 0) return 0.0;
  if (stages.empty()) return centre_distance_mm;
  const std::string& name = topology().members[static_cast<std::size_t>(member)].name;
  for (const GearTrain& stage : stages)
    if (const int own = stage.topology().find_member(name); own != kNoMember) return stage.axis_distance_mm(own);
  return kNaN;
}

std::vector<const GearTrain*> GearTrain::each_stage() const {
  if (stages.empty()) return {this};
  std::vector<const GearTrain*> all;
  for (const GearTrain& stage : stages) all.push_back(&stage);
  return all;
}

}  // namespace trueflank
