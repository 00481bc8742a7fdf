// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_machine.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/machine/crossed_rollers.h"

namespace trueflank {
namespace {

/// A hub holds a shaft over one and a half of its diameters, over one at least (a rule of thumb).
constexpr double kGrip = 1.5, kLeastGrip = 1.0;
/// What turns and what does not stay this part of clearance_mm apart, or it is reported.
constexpr double kLeastGap = 0.5;
/// Between the seats of a planet's two bearings.
constexpr double kBetweenSeats_mm = 1.0;

Finding judged(Finding finding, double least) {
  finding.margin = finding.value - finding.limit;
  if (std::abs(finding.margin) < tolerance::kTouch_mm) finding.margin = 0.0;
  finding.status = finding.margin >= 0.0    ? CheckStatus::kPass
                   : finding.value >= least ? CheckStatus::kWarn
                                            : CheckStatus::kFail;
  if (finding.status == CheckStatus::kPass) finding.cure.clear();
  return finding;
}

Finding housing_size(const MachineLayout& m) {
  const double needed = 2.0 * m.least_outer_radius_mm, value = 2.0 * m.asked_radius_mm;
  return judged(
      {.id = "housing_size",
       .where = "housing",
       .value = value,
       .limit = needed,
       .unit = "mm",
       .message =
           "outer diameter " + mm_text(value) + ", ring, screws and walls need " + mm_text(needed),
       .cure = "outer_diameter_mm in [housing] of " + mm_text(std::ceil(10.0 * needed) / 10.0) +
               " at least, or smaller fasteners.housing"},
      needed);
}

Findings walls(const GearTrain& train, const MachineLayout& m, const PartShapes& shapes) {
  Findings findings;
  const auto& process = train.design.made.process;
  const double least = process ? process->least_wall_mm : 0.5 * m.wall_mm;
  for (const PartShape& part : shapes.parts) {
    if (!part.bought.empty()) continue;
    const ThinnestWall wall = thinnest_wall(part);
    if (std::isnan(wall.width_mm)) continue;
    Finding finding =
        judged({.id = "wall",
                .where = part.name,
                .value = wall.width_mm,
                .limit = least,
                .unit = "mm",
                .message = part.name + ": the thinnest wall is " + mm_text(wall.width_mm) + ", " +
                           mm_text(wall.height_mm) + " above its lower face",
                .cure = "a larger outer_diameter_mm, smaller fasteners, or another bearing"},
               1e-3);
    if (finding.status != CheckStatus::kPass && m.idle_gear >= 0 &&
        part.name == train.topology().gears[static_cast<std::size_t>(m.idle_gear)].name)
      finding.cure = "no [" + part.name + "]: it idles; or a motor whose shaft ends below it";
    if (finding.status == CheckStatus::kFail)
      finding.message = part.name + ": two surfaces run into each other by " +
                        mm_text(-wall.width_mm) + ", " + mm_text(wall.height_mm) +
                        " above its lower face";
    findings.push_back(std::move(finding));
  }
  return findings;
}

Finding judge_screws(const ScrewGroup& group) {
  Finding finding{.id = "screws",
                  .where = group.what,
                  .value = group.length_mm,
                  .limit = group.shortest_mm,
                  .unit = "mm"};
  const std::string range = mm_text(group.shortest_mm) + " to " + mm_text(group.longest_mm);
  if (group.fits()) {
    finding.margin = group.length_mm - group.shortest_mm;
    finding.message = std::to_string(group.at.size()) + " screws " + group.screw.name + " of " +
                      mm_text(group.length_mm) + " hold; " + range + " would";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  finding.margin = -1.0;
  finding.message = "no stocked " + group.screw.name + " is " + range + " long";
  finding.cure = group.what == "motor" ? "another floor_mm in [housing]"
                 : group.what == "carrier"
                     ? "a thicker plate_thickness_mm in [carrier], or another screw for "
                       "fasteners.carrier"
                     : "another screw in [fasteners], or longer ones ([screw.NAME])";
  return finding;
}

/// Whether a key gets to every head: the heads of the motor's screws lie in the cavity.
Finding screw_access(const MachineLayout& m) {
  const ScrewGroup& group = m.motor_screws;
  double room = 1e300;
  for (const Point2& at : group.at)
    room = std::min(room, m.cavity_radius_mm - at.norm() - 0.5 * group.screw.head_diameter_mm);
  return judged(
      {.id = "screw_access",
       .where = "motor",
       .value = room,
       .limit = 0.0,
       .unit = "mm",
       .message =
           room < 0.0
               ? "the heads of the motor's screws run into the housing's wall by " + mm_text(-room)
               : "the heads of the motor's screws clear the housing's wall by " + mm_text(room),
       .cure = "a motor of a smaller screw circle, or larger gears"},
      0.0);
}

Finding shaft_grip(const GearTrain& train, const MachineLayout& m) {
  const Motor& motor = train.design.machine->motor;
  const std::string where = train.topology().name_of(train.topology().input);
  const double grip = m.gripped.upper_mm - m.gripped.lower_mm,
               wanted = kGrip * motor.shaft_diameter_mm;
  Finding finding =
      judged({.id = "shaft_grip",
              .where = where,
              .value = grip,
              .limit = wanted,
              .unit = "mm",
              .message = "the motor's shaft is " + mm_text(std::max(0.0, grip)) + " deep in the " +
                         where + ", one and a half diameters are " + mm_text(wanted),
              .cure = "a motor whose shaft_length_mm is longer by " + mm_text(wanted - grip) +
                      ", or thinner floor and carrier plate"},
             kLeastGrip * motor.shaft_diameter_mm);
  const GearDesign* gear =
      m.driven_gear < 0 ? nullptr : &train.design.gears[static_cast<std::size_t>(m.driven_gear)];
  if (gear && !(gear->bore.diameter_mm > motor.shaft_diameter_mm)) {
    finding.status = CheckStatus::kFail;
    finding.message = "the motor's shaft of " + mm_text(motor.shaft_diameter_mm) +
                      " does not go into the bore of " + mm_text(gear->bore.diameter_mm);
    finding.cure = "bore_mm in [" + gear->name + "] of more, or none: it follows from the shaft";
  }
  return finding;
}

Findings bearing_seats(const GearTrain& train) {
  Findings findings;
  const auto& planet = train.design.machine->bearings.planet;
  if (planet) {
    double top = -1e300, bottom = 1e300;
    for (std::size_t i = 0; i < train.gears.size(); ++i) {
      if (!train.topology().is_planet_gear(i)) continue;
      top = std::max(top, train.gears[i].z_lower_mm + train.gears[i].face_width_mm);
      bottom = std::min(bottom, train.gears[i].z_lower_mm);
    }
    const double room = top - bottom - kBetweenSeats_mm;
    findings.push_back(judged(
        {.id = "bearing_seat",
         .where = "planet",
         .value = room,
         .limit = 2.0 * planet->width_mm,
         .unit = "mm",
         .message = "two bearings " + planet->name + " are " + mm_text(2.0 * planet->width_mm) +
                    " wide, the planet has " + mm_text(room) + " for them",
         .cure = "wider gears, or a narrower bearing"},
        2.0 * planet->width_mm));
  }
  return findings;
}

Finding judge_life(const std::string& where, const Bearing& bearing, const BearingLoad& load,
                   double wanted_h) {
  Finding finding{.id = "bearing_load", .where = where, .limit = wanted_h, .unit = "h"};
  const BearingLife life = bearing_life(bearing, load);
  const std::string force =
      number_text(life.equivalent_n, 0) + " N at " + number_text(load.speed_rpm, 1) + " rpm";
  if (std::isnan(life.life_h)) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "bearing " + bearing.name + " has no load rating; it carries " + force;
    return finding;
  }
  if (std::isinf(life.life_h)) {
    finding.message = "bearing " + bearing.name + " carries nothing";
    return finding;
  }
  finding.value = life.life_h;
  finding.message = "bearing " + bearing.name + " carries " + force + ": " +
                    number_text(life.life_h, 0) + " h (ISO 281), wanted " +
                    number_text(wanted_h, 0) + " h";
  finding.cure = "a larger bearing, or a smaller load";
  finding = judged(std::move(finding), wanted_h);
  if (life.static_safety < 1.0) {
    finding.status = CheckStatus::kFail;
    finding.message +=
        "; its static rating is exceeded by " + number_text(1.0 / life.static_safety, 2) + " times";
    finding.cure = "a larger bearing, or a smaller load";
  }
  return finding;
}

/// The output's bearings share the load; two and more also carry its tilting moment.
BearingLoad output_load(const MachineDesign& machine, const MachineLayout& m) {
  const double width = machine.bearings.output.width_mm;
  const int n = machine.bearings.outputs;
  BearingLoad load{.radial_n = machine.output.radial_load_n,
                   .axial_n = machine.output.axial_load_n,
                   .speed_rpm = machine.output.speed_rpm};
  const double arm = m.plate.upper_mm - m.bearings.upper_mm + 0.5 * width;
  if (n == 1) {
    load.tilting_nmm = load.radial_n * arm;
  } else {
    const double span = (n - 1) * width;
    load.radial_n *= (arm + span) / span;
  }
  return load;
}

Findings bearing_loads(const GearTrain& train, const MachineLayout& m) {
  const MachineDesign& machine = *train.design.machine;
  const double wanted = machine.bearings.life_h;
  Findings findings{judge_life("output", machine.bearings.output, output_load(machine, m), wanted)};
  if (machine.output.radial_load_n > 0.0 && machine.bearings.outputs == 1 &&
      !is_crossed_roller(machine.bearings.output)) {
    findings.back().status = std::max(findings.back().status, CheckStatus::kWarn);
    findings.back().cure =
        "outputs = 2 in [bearings], or crossed rollers: one ball bearing alone holds no tilting "
        "load";
  }
  if (!machine.bearings.planet) return findings;
  const MachineLoads loads = machine_loads(train);
  if (std::isnan(loads.pin_force_n)) return findings;
  findings.push_back(judge_life(
      "planet", *machine.bearings.planet,
      {.radial_n = 0.5 * loads.pin_force_n, .speed_rpm = loads.planet_speed_rpm}, wanted));
  return findings;
}

Finding collision(const GearTrain& train, const PartShapes& shapes) {
  const AssemblyClearance clearance = assembly_clearance(train, shapes);
  Finding finding{.id = "collision",
                  .where = "train",
                  .value = clearance.least_gap_mm,
                  .limit = 0.0,
                  .margin = clearance.least_gap_mm,
                  .unit = "mm"};
  if (clearance.collisions.empty()) {
    finding.message = "nothing runs into anything through a whole turn; " + clearance.body1 +
                      " and " + clearance.body2 + " come nearest, " +
                      mm_text(clearance.least_gap_mm);
    const double wanted = kLeastGap * train.design.machine->housing.clearance_mm;
    if (clearance.least_gap_mm >= wanted - tolerance::kTouch_mm) return finding;
    finding.status = CheckStatus::kWarn;
    finding.limit = wanted;
    finding.margin = clearance.least_gap_mm - wanted;
    finding.message += ": they may rub";
    finding.cure =
        "a gap of " + mm_text(wanted) +
        ": where a planet stands against a ring's cup, a face_width_mm of the ring that is larger";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  const auto deepest = std::max_element(
      clearance.collisions.begin(), clearance.collisions.end(),
      [](const Collision& a, const Collision& b) { return a.depth_mm < b.depth_mm; });
  finding.value = finding.margin = -deepest->depth_mm;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, clearance.collisions.size()); ++i) {
    const Collision& c = clearance.collisions[i];
    finding.message +=
        (i > 0 ? "; " : "") + c.body1 + " runs into " + c.body2 + " by " + mm_text(c.depth_mm);
  }
  if (clearance.collisions.size() > 4)
    finding.message += "; and " + std::to_string(clearance.collisions.size() - 4) + " more";
  finding.cure = "other sizes of the two: see their tables";
  return finding;
}

std::string body_text(const PartShapes& shapes, std::size_t body) {
  return shapes.assembly[body].name;
}

/// Two of the bodies that hold each other: made ones with teeth say most.
std::pair<std::size_t, std::size_t> held_pair(const PartShapes& shapes,
                                              const std::vector<std::size_t>& stuck) {
  std::vector<std::size_t> gears;
  for (const std::size_t body : stuck)
    if (const PartRole role =
            shapes.parts[static_cast<std::size_t>(shapes.assembly[body].part)].role;
        role == PartRole::kSun || role == PartRole::kPlanet || role == PartRole::kRing ||
        role == PartRole::kUpperRing)
      gears.push_back(body);
  const std::vector<std::size_t>& from = gears.size() > 1 ? gears : stuck;
  return {from.front(), from[1]};
}

Finding order_of_assembly(const GearTrain& train, const PartShapes& shapes, bool collides) {
  const AssemblyOrder order = assembly_order(train, shapes);
  Finding finding{.id = "assembly_order",
                  .where = "train",
                  .value = static_cast<double>(order.stuck.size()),
                  .limit = 0.0,
                  .margin = -static_cast<double>(order.stuck.size())};
  if (order.exists()) {
    finding.margin = 0.0;
    finding.message = "all " + std::to_string(shapes.assembly.size()) +
                      " bodies go in along the axis one after the other, none meets another";
    return finding;
  }
  finding.status = CheckStatus::kFail;
  const auto [one, other] = held_pair(shapes, order.stuck);
  finding.message = std::to_string(order.stuck.size()) +
                    " bodies hold each other and cannot be put together along the axis, " +
                    body_text(shapes, one) + " and " + body_text(shapes, other) + " among them";
  const auto any_gear = [&](const auto& is) {
    return std::any_of(train.gears.begin(), train.gears.end(), is);
  };
  const double plate_mm = 0.5 * carrier_layout(train)->outer_diameter_mm;
  if (any_gear([](const TrainGear& gear) { return gear.twist.herringbone; }))
    finding.cure =
        "herringbone = false in [gearbox]: such teeth go in only where every ring is made in halves";
  else if (any_gear([&](const TrainGear& gear) {
             return gear.profile.gear().kind == GearKind::kInternal &&
                    gear.profile.tip_radius_mm() < plate_mm;
           }))
    finding.cure = "a smaller outer_diameter_mm in [carrier], or none: it follows from the rings";
  else if (collides)
    finding.cure = "see collision: what runs into each other holds each other";
  else
    finding.cure = "other sizes of the two: see their tables";
  return finding;
}

}  // namespace

MachineLoads machine_loads(const GearTrain& train) {
  MachineLoads loads;
  const MachineDesign& machine = *train.design.machine;
  const Topology& topology = train.topology();
  std::vector<int> teeth;
  for (const TrainGear& gear : train.gears)
    teeth.push_back(gear.profile.gear().kind == GearKind::kInternal ? -gear.profile.gear().teeth
                                                                    : gear.profile.gear().teeth);
  const BalanceState state =
      solve_balance(balance_train(topology, teeth), DriveDirection::kForward);
  const auto output = static_cast<std::size_t>(topology.output),
             input = static_cast<std::size_t>(topology.input);
  const double ratio = std::abs(state.torque[output] / state.torque[input]);
  loads.output_torque_nm = machine.output.torque_nm.value_or(machine.motor.torque_nm * ratio);
  const double driving_nm = loads.output_torque_nm / ratio;
  // on a planet: along each mesh's line of action, across the radius to the planet
  double across = 0.0, along = 0.0;
  for (std::size_t i = 0; i < train.meshes.size(); ++i) {
    const TrainMesh& mesh = train.meshes[i];
    const bool first = topology.is_planet_gear(static_cast<std::size_t>(mesh.gear1));
    const TrainGear& planet = train.gear(first ? mesh.gear1 : mesh.gear2);
    const double torque = (first ? state.meshes[i].torque1 : state.meshes[i].torque2) * driving_nm;
    if (std::isnan(torque)) continue;
    const double working = working_pressure_angle_rad(train.pair(mesh));
    const double pitch_mm = base_radius_mm(planet.profile.gear()) / std::cos(working);
    const double tangential = 1000.0 * torque / train.design.planets / pitch_mm;
    const bool ring = train.gear(mesh.gear2).profile.gear().kind == GearKind::kInternal;
    across += ring ? tangential : -tangential;
    along += (ring ? -1.0 : 1.0) * std::abs(tangential) * std::tan(working);
  }
  loads.pin_force_n = std::hypot(across, along);
  const int planet = topology.first_planet();
  const auto& speed = state.speed;
  const double relative = speed[static_cast<std::size_t>(planet)] -
                          speed[static_cast<std::size_t>(topology.carrier_of(planet))];
  loads.planet_speed_rpm = std::abs(relative / speed[output]) * machine.output.speed_rpm;
  return loads;
}

Findings check_machine(const GearTrain& train, const PartShapes& shapes) {
  const auto layout = machine_layout(train);
  if (!layout) return {};
  const MachineLayout& m = *layout;
  Findings all{housing_size(m)};
  const auto append = [&](Findings some) { all.insert(all.end(), some.begin(), some.end()); };
  append(walls(train, m, shapes));
  for (const ScrewGroup* group : {&m.motor_screws, &m.housing_screws, &m.carrier_screws,
                                  &m.output_screws, &m.retainer_screws})
    all.push_back(judge_screws(*group));
  all.push_back(screw_access(m));
  all.push_back(shaft_grip(train, m));
  append(bearing_seats(train));
  append(bearing_loads(train, m));
  all.push_back(collision(train, shapes));
  const bool collides = all.back().status == CheckStatus::kFail;
  all.push_back(order_of_assembly(train, shapes, collides));
  return all;
}

}  // namespace trueflank
