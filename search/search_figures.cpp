// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/base/contract.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/inertia.h"
#include "trueflank/train/losses.h"
#include "trueflank/train/materials.h"

namespace trueflank {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kChords = 24;  ///< of each piece of a tooth, for its area

/// Area and second polar moment about the gear's axis of what a profile encloses.
struct Section {
  double area_mm2 = 0.0, polar_mm4 = 0.0;
};

/// Green's theorem over the chords of half a tooth, which is there 2 z times.
Section enclosed(const ToothProfile& profile) {
  Section sum;
  for (const ProfilePiece& piece : profile.pieces()) {
    Point2 p = piece.curve.start_point();
    for (int i = 1; i <= kChords; ++i) {
      const Point2 q = point_at(
          piece.curve, std::lerp(piece.curve.begin, piece.curve.end, static_cast<double>(i) / kChords));
      const double cross = p.x() * q.y() - q.x() * p.y();
      sum.area_mm2 += 0.5 * cross;
      sum.polar_mm4 += cross / 12.0 * (p.squaredNorm() + p.dot(q) + q.squaredNorm());
      p = q;
    }
  }
  const double times = 2.0 * profile.gear().teeth;
  return {times * sum.area_mm2, times * sum.polar_mm4};
}

/// Of the gear's material; a ring's rim is that of the design.
Section section_of(const GearDesign& design, const ToothProfile& profile) {
  const Section teeth = enclosed(profile);
  if (design.kind != GearKind::kInternal) return teeth;
  const double radius = 0.5 * design.outer_diameter_mm.value_or(0.0), square = radius * radius;
  return {kPi * square - teeth.area_mm2, 0.5 * kPi * square * square - teeth.polar_mm4};
}

/// The neck between the gears of a body, as its part has it: a little inside both root circles.
void add_neck(const GearTrain& train, int member, double density_kg_m3, BodyInertia& body) {
  constexpr double kInset = 0.25;  // of the smaller module
  const std::vector<int> gears = train.topology().gears_of(member);
  for (std::size_t i = 1; i < gears.size(); ++i) {
    const TrainGear &lower = train.gear(gears[i - 1]), &upper = train.gear(gears[i]);
    const double radius =
        std::min(lower.profile.root_radius_mm(), upper.profile.root_radius_mm()) -
        kInset * std::min(lower.profile.gear().normal_module_mm, upper.profile.gear().normal_module_mm);
    const double gap = upper.z_lower_mm - lower.z_lower_mm - lower.face_width_mm;
    const double mass = density_kg_m3 * 1e-9 * gap * kPi * radius * radius;
    body.mass_kg += mass;
    body.axial_kg_m2 += 0.5 * mass * radius * radius * 1e-6;
  }
}

BodyInertias bodies_of(const GearTrain& train, double density_kg_m3) {
  BodyInertias bodies(train.topology().members.size());
  for (std::size_t g = 0; g < train.gears.size(); ++g) {
    const Section section = section_of(train.design.gears[g], train.gears[g].profile);
    BodyInertia& body = bodies[static_cast<std::size_t>(train.topology().gears[g].member)];
    const double surface_density = density_kg_m3 * 1e-9 * train.gears[g].face_width_mm;
    body.mass_kg += surface_density * section.area_mm2;
    body.axial_kg_m2 += surface_density * section.polar_mm4 * 1e-6;
  }
  for (std::size_t m = 0; m < bodies.size(); ++m)
    add_neck(train, static_cast<int>(m), density_kg_m3, bodies[m]);
  return bodies;
}

double mass_of(const GearTrain& train, const BodyInertias& bodies) {
  double mass = 0.0;
  for (std::size_t m = 0; m < bodies.size(); ++m)
    mass += train.copies_of(static_cast<int>(m)) * bodies[m].mass_kg;
  return mass;
}

double length_of(const GearTrain& train) {
  double low = kInfinite, high = -kInfinite;
  for (const TrainGear& gear : train.gears) {
    low = std::min(low, gear.z_lower_mm);
    high = std::max(high, gear.z_lower_mm + gear.face_width_mm);
  }
  return high - low;
}

double least_contact_ratio(const GearTrain& train) {
  double least = kInfinite;
  for (const TrainMesh& mesh : train.meshes)
    least = std::min(least, contact_ratios(train.pair(mesh)).effective);
  return least;
}

/// At the ends of contact, where it is greatest: 1 less the ratio of the surfaces' speeds, of the
/// slower one.
double greatest_sliding(const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  const double gear_ratio = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  double greatest = 0.0;
  for (const double roll1 : {line.effective_start_mm, line.effective_end_mm}) {
    const double roll2 = pair.internal() ? roll1 + span : span - roll1;
    if (!(roll1 > 0.0 && roll2 > 0.0)) return kInfinite;
    const double speeds = gear_ratio * roll2 / roll1;
    greatest = std::max({greatest, std::abs(1.0 - speeds), std::abs(1.0 - 1.0 / speeds)});
  }
  return greatest;
}

double greatest_sliding(const GearTrain& train) {
  double greatest = 0.0;
  for (const TrainMesh& mesh : train.meshes)
    greatest = std::max(greatest, greatest_sliding(train.pair(mesh)));
  return greatest;
}

/// By virtual work: a mesh's play turns the output by what its tangential force is of the output's
/// torque, nothing being lost.
double output_backlash_arcmin(const GearTrain& train) {
  std::vector<int> teeth;
  for (const TrainGear& gear : train.gears) {
    const Gear& g = gear.profile.gear();
    teeth.push_back(g.kind == GearKind::kInternal ? -g.teeth : g.teeth);
  }
  const BalanceState state =
      solve_balance(balance_train(train.topology(), teeth), DriveDirection::kForward);
  const double output_torque = std::abs(1.0 / train.speeds.output);  // per unit at the input
  double turn = 0.0;
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const double force = std::abs(state.meshes[k].torque1) / pitch_radius1_mm(train.pair(train.meshes[k]));
    turn += force / output_torque * train.meshes[k].backlash_mm;
  }
  return 60.0 * deg_from_rad(turn);
}

/// Rest to rest: torque of the motor one way, then the other, with its greatest speed between.
struct Motion {
  double acceleration = kNaN, settling_s = kNaN;
};
Motion motion_of(const SearchRequirements& r, const ReflectedInertia& inertia, double ratio,
                 double forward, double backward) {
  const MotorDesign& motor = r.motor;
  if (std::isnan(motor.torque_nm)) return {};
  const double drag = r.losses ? drag_at_rest_nm(r) : 0.0;
  const double j1 = inertia.input_side_kg_m2, j2 = inertia.output_side_kg_m2;
  Motion motion;
  motion.acceleration = (ratio * forward * (motor.torque_nm - drag) - motor.load_nm) /
                        (j2 + ratio * ratio * forward * j1);
  if (!(motion.acceleration > 0.0)) return {0.0, kInfinite};
  // braking: the load drives the train where its inertia asks for more than its torque takes
  double braking = (ratio * (motor.torque_nm + drag) + backward * motor.load_nm) /
                   (ratio * ratio * j1 + backward * j2);
  if (j2 * braking < motor.load_nm)
    braking = (ratio * forward * (motor.torque_nm + drag) + motor.load_nm) /
              (ratio * ratio * forward * j1 + j2);
  const double peak = std::sqrt(2.0 * motor.move_rad * motion.acceleration * braking /
                                (motion.acceleration + braking));
  const double fastest = std::isnan(motor.speed_rpm)
                             ? kInfinite
                             : motor.speed_rpm * kTwoPi / 60.0 / ratio;
  const double each_way = 1.0 / motion.acceleration + 1.0 / braking;
  motion.settling_s = peak <= fastest ? peak * each_way
                                      : motor.move_rad / fastest + 0.5 * fastest * each_way;
  return motion;
}

}  // namespace

const std::vector<ObjectiveEntry>& objective_entries() {
  using enum SearchObjective;
  static const std::vector<ObjectiveEntry> kEntries{
      {kForward, "forward", "forward", "forward efficiency", "limits.forward_min", true},
      {kBackward, "backward", "backward", "backward efficiency", "limits.backward_min", true},
      {kTorque, "torque", "output_torque_nm", "allowable output torque [N m]", "strength.output_torque_nm", true},
      {kSize, "size", "outer_diameter_mm", "outer diameter [mm]", "limits.outer_diameter_max_mm", false},
      {kMass, "mass", "mass_kg", "mass of the gears [kg]", "limits.mass_max_kg", false},
      {kLength, "length", "length_mm", "length of the gears [mm]", "limits.length_max_mm", false},
      {kTorqueDensity, "torque_density", "torque_density_nm_per_kg", "torque density [N m/kg]",
       "limits.torque_density_min_nm_per_kg", true},
      {kStartingTorque, "starting_torque", "starting_torque_nm", "starting torque backwards [N m]",
       "limits.starting_torque_max_nm", false},
      {kInputInertia, "input_inertia", "input_inertia_kg_m2", "inertia at the input [kg m2]",
       "limits.input_inertia_max_kg_m2", false},
      {kOutputInertia, "output_inertia", "output_inertia_kg_m2", "inertia at the output [kg m2]",
       "limits.output_inertia_max_kg_m2", false},
      {kContactRatio, "contact_ratio", "contact_ratio", "least contact ratio", "limits.contact_ratio_min", true},
      {kSliding, "sliding", "sliding", "greatest specific sliding", "limits.sliding_max", false},
      {kBacklash, "backlash", "backlash_arcmin", "backlash of the output [arcmin]",
       "limits.backlash_max_arcmin", false},
      {kAcceleration, "acceleration", "acceleration_rad_s2", "acceleration of the load [rad/s2]",
       "limits.acceleration_min_rad_s2", true},
      {kSettling, "settling", "settling_s", "time of a move [s]", "limits.settling_max_s", false}};
  return kEntries;
}

const ObjectiveEntry& objective_entry(SearchObjective objective) {
  static const ObjectiveEntry kWeightedEntry{
      SearchObjective::kWeighted, "weighted", "score", "weighted score", "", true};
  for (const ObjectiveEntry& entry : objective_entries())
    if (entry.objective == objective) return entry;
  return kWeightedEntry;
}

const char* to_text(SearchObjective objective) { return objective_entry(objective).name; }

double drag_at_rest_nm(const SearchRequirements& r) {
  if (!r.losses) return kNaN;
  return loss_torque_nm(*r.losses, {.temperature_c = r.losses->temperature_c.value_or(kNaN)}, 0.0);
}

DesignFigures design_figures(const SearchRequirements& r, const GearTrain& train,
                             double mesh_forward, double mesh_backward, double torque_nm) {
  TRUEFLANK_EXPECTS(!train.meshes.empty());
  DesignFigures f;
  const Material* material = r.strength.materials.find(r.strength.material);
  const BodyInertias bodies = bodies_of(train, material ? material->density_kg_m3 : kNaN);
  f.mass_kg = mass_of(train, bodies);
  f.length_mm = length_of(train);
  f.torque_density_nm_per_kg = torque_nm / f.mass_kg;
  const EfficiencyResult efficiency{.forward = mesh_forward,
                                    .backward = mesh_backward,
                                    .self_locking = !(mesh_backward > 0.0)};
  const ReflectedInertia inertia =
      reflected_inertia(train, efficiency, bodies,
                        {.rotor_kg_m2 = r.motor.rotor_kg_m2,
                         .load_kg_m2 = r.motor.load_kg_m2,
                         .drag_torque_nm = drag_at_rest_nm(r)});
  f.starting_torque_nm = inertia.starting_torque_nm;
  f.input_inertia_kg_m2 = inertia.at_input_forward_kg_m2;
  f.output_inertia_kg_m2 = inertia.at_output_backward_kg_m2;
  f.contact_ratio = least_contact_ratio(train);
  f.sliding = greatest_sliding(train);
  f.backlash_arcmin = output_backlash_arcmin(train);
  const Motion motion = motion_of(r, inertia, std::abs(1.0 / train.speeds.output), mesh_forward,
                                  mesh_backward);
  f.acceleration_rad_s2 = motion.acceleration;
  f.settling_s = motion.settling_s;
  return f;
}

double figure_of(const DesignFigures& f, SearchObjective objective) {
  switch (objective) {
    case SearchObjective::kMass:
      return f.mass_kg;
    case SearchObjective::kLength:
      return f.length_mm;
    case SearchObjective::kTorqueDensity:
      return f.torque_density_nm_per_kg;
    case SearchObjective::kStartingTorque:
      return f.starting_torque_nm;
    case SearchObjective::kInputInertia:
      return f.input_inertia_kg_m2;
    case SearchObjective::kOutputInertia:
      return f.output_inertia_kg_m2;
    case SearchObjective::kContactRatio:
      return f.contact_ratio;
    case SearchObjective::kSliding:
      return f.sliding;
    case SearchObjective::kBacklash:
      return f.backlash_arcmin;
    case SearchObjective::kAcceleration:
      return f.acceleration_rad_s2;
    case SearchObjective::kSettling:
      return f.settling_s;
    default:
      return kNaN;
  }
}

}  // namespace trueflank
