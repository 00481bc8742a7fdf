// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/wished_machine.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/gear_train.h"
#include "trueflank/train/machine/machine_layout.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {
namespace {

/// The gears are scaled at most so often, to this much below the outer diameter asked for.
constexpr int kScalings = 7;
constexpr double kSpare_mm = 0.05;
/// A bore holds so much more than the motor's torque on the flat of its shaft.
constexpr double kFlatReserve = 1.05;
/// Of planets without bearings; and what two bearings in a planet leave between them.
constexpr double kPlainPin_mm = 4.0, kBetweenBearings_mm = 1.0;

Screw screw_of(const std::string& name) { return *find_element(standard_elements().screws, name); }

/// What is driven gets the bore of the motor's shaft.
void shaft_gear(GearboxDesign& design, const MachineDesign& machine) {
  const Topology& topology = design.topology;
  for (std::size_t i = 0; i < topology.gears.size(); ++i)
    if (topology.gears[i].member == topology.input) design.gears[i].bore = shaft_bore(machine);
}

/// Whether the process prints the roof of a bearing's seat over the narrower bore.
bool is_bridged(const GearboxDesign& design, const MachineDesign& machine, const Bearing& bearing) {
  const double most = design.made.process ? design.made.process->bridge_mm : 0.0;
  const double seat = seat_fits(machine).planet.hole_mm(bearing.outer_mm),
               bore = bore_between(bearing);
  return !(most > 0.0) || std::sqrt(seat * seat - bore * bore) <= most;
}

/// The largest that the planets' roots and faces have room for; none: they turn on their pins.
void choose_planet_bearing(GearboxDesign& design, double wall_mm) {
  MachineDesign& machine = *design.machine;
  const auto train = lay_out(design);
  if (!train) return;
  double root = 1e300, lower = 1e300, upper = -1e300;
  for (std::size_t i = 0; i < train->gears.size(); ++i) {
    const TrainGear& gear = train->gears[i];
    if (!train->topology().is_planet_gear(i)) continue;
    root = std::min(root, gear.profile.root_radius_mm());
    lower = std::min(lower, gear.z_lower_mm);
    upper = std::max(upper, gear.z_lower_mm + gear.face_width_mm);
  }
  BoreDesign& bore =
      design.gears[static_cast<std::size_t>(planet_with_bore(design) - design.gears.data())].bore;
  for (const char* name : {"608", "626", "625", "624", "623", "684"}) {
    const Bearing& bearing = *find_element(standard_elements().bearings, name);
    if (0.5 * seat_fits(machine).planet.hole_mm(bearing.outer_mm) + wall_mm > root) continue;
    if (2.0 * bearing.width_mm + kBetweenBearings_mm > upper - lower) continue;
    if (!is_bridged(design, machine, bearing)) continue;
    machine.bearings.planet = bearing;
    bore.diameter_mm = bore_between(bearing);
    return;
  }
  machine.bearings.planet.reset();
  bore.diameter_mm = kPlainPin_mm + CarrierDesign{}.pin_clearance_mm;
}

/// Least wall between the output's screws, the inserts for the load, and what else is drilled into
/// the carrier where that drives out.
double wall_of_output_mm(const GearTrain& train, const MachineLayout& m) {
  const Screw& screw = m.output_screws.screw;
  const double insert = 0.5 * screw.insert_hole_mm,
               head = 0.5 * screw.head_diameter_mm + kHeadRoom_mm;
  const double apart = (m.output_screws.at.front() - m.load_inserts.front()).norm();
  double wall = apart - std::max(head + 0.5 * screw.hole_mm, insert + 0.5 * screw.hole_mm);
  if (m.output_gear >= 0 || m.wheel_gear >= 0) return wall;
  for (const Point2& at : m.output_screws.at) {
    for (const Point2& pillar : m.pillars)
      wall = std::min(wall,
                      (at - pillar).norm() - insert - 0.5 * m.carrier_screws.screw.insert_hole_mm);
    for (const double angle : train.phases.positions_rad(train.topology().first_planet()))
      wall = std::min(wall, (at - train.centre_distance_mm * unit_vector(angle)).norm() - insert -
                                0.5 * m.carrier.pin_hole_diameter_mm);
    wall = std::min(wall, at.norm() - insert - m.stop_hole_radius_mm);
  }
  return wall;
}

/// What turns inside the lid reaches as far, from the output's axis.
double inside_lid_mm(const GearTrain& train, const MachineLayout& m) {
  if (m.wheel_gear >= 0)
    return train.gear(m.wheel_gear).profile.tip_radius_mm() - m.wall_mm - m.fit_mm;
  return std::max(m.cup_radius_mm, 0.5 * m.carrier.outer_diameter_mm);
}

/// The largest whose retainer is no wider than what turns inside the lid, and whose screws leave
/// walls.
void choose_output_bearing(GearboxDesign& design, double wall_mm) {
  MachineDesign& machine = *design.machine;
  auto train = lay_out(design);  // the gears do not depend on what is chosen here
  if (!train) return;
  const auto fits = [&](const char* screw, const char* bearing, int bolts) {
    machine.fasteners.output = screw_of(screw);
    machine.bearings.output = *find_element(standard_elements().bearings, bearing);
    machine.output.bolts = bolts;
    train->design.machine = machine;
    const auto m = machine_layout(*train);
    return m && wall_of_output_mm(*train, *m) >= wall_mm &&
           m->retainer_radius_mm <= inside_lid_mm(*train, *m);
  };
  const int usual = OutputDesign{}.bolts;
  for (const char* screw : {"M3", "M2.5"})
    for (const int bolts : {usual, 3})
      for (const char* name : {"6815", "6812", "6810", "6808", "6806", "6804", "6803", "6802"})
        if (fits(screw, name, bolts)) return;
  fits("M3", "6804", usual);
}

/// Of a pair, under the wheel: the largest that leaves walls to the motor's collar and screws, and
/// the inserts of the output's screws free.
void choose_wheel_bearing(GearboxDesign& design, double wall_mm) {
  MachineDesign& machine = *design.machine;
  machine.bearings.wheel.reset();
  machine.bearings.outputs = 1;
  auto train = lay_out(design);
  if (!train) return;
  for (const char* name : {"608", "626", "688", "686", "625", "685", "624", "684"}) {
    const Bearing& bearing = *find_element(standard_elements().bearings, name);
    train->design.machine->bearings.wheel = bearing;
    const auto m = machine_layout(*train);
    const double seat = 0.5 * m->fits.wheel.hole_mm(bearing.outer_mm);
    double wall = m->output_axis.norm() - seat - m->floor_hole_radius_mm;
    for (const Point2& at : m->motor_screws.at)
      wall = std::min(wall, (m->output_axis - at).norm() - seat - kHeadRoom_mm -
                                0.5 * m->motor_screws.screw.head_diameter_mm);
    const double inserts =
        m->output_screws.at.front().norm() - 0.5 * m->output_screws.screw.insert_hole_mm;
    if (wall < wall_mm || inserts < m->stub.inner_shoulder_mm) continue;
    machine.bearings.wheel = bearing;
    return;
  }
  machine.bearings.outputs = 2;
}

/// A carrier on the motor's shaft has so thick a plate that its bore holds the motor's torque on
/// the shaft's flat. Whether it was too thin, and the shaft long enough.
bool thicken_plates(GearboxDesign& design, const GearTrain& train, const MachineLayout& m) {
  const double torque = design.machine->motor.torque_nm, per_mm = held_by_flat_nm(train, 1.0);
  if (m.driven_gear >= 0 || !(design.machine->motor.flat_mm > 0.0)) return false;
  const double lacking = kFlatReserve * torque / per_mm - flat_in_bore_mm(m);
  const bool reaches = m.shaft_end_mm > m.near.upper_mm + lacking;
  if (!(lacking > kSpare_mm) || !reaches) return false;
  if (!design.carrier)
    design.carrier =
        CarrierDesign{.pin_hole_clearance_mm = std::max(design.machine->housing.fit_mm,
                                                        CarrierDesign{}.pin_hole_clearance_mm)};
  design.carrier->plate_thickness_mm = m.near.upper_mm - m.near.lower_mm +
                                       std::max(0.0, m.flat_from_mm - m.gripped.upper_mm) + lacking;
  return true;
}

/// Gears alike, so that the housing has the diameter asked for; the shifts stay.
void scale(GearboxDesign& design, double factor) {
  design.module_mm *= factor;
  *design.centre_distance_mm *= factor;
}
/// How much the housing grows with the gears: by this for twice their size. Round a pair stands the
/// circle of the motor's screws too, which does not.
double growing_diameter_mm(const GearTrain& train, const MachineLayout& m) {
  if (m.wheel_gear >= 0)
    return train.centre_distance_mm + train.gear(m.wheel_gear).profile.tip_radius_mm();
  double largest = 0.0;
  for (const TrainGear& gear : train.gears)
    largest = std::max(largest, 2.0 * gear.profile.root_radius_mm());
  return largest;
}

}  // namespace

GearboxDesign with_machine(GearboxDesign design, const Motor& motor, double outer_diameter_mm,
                           double wall_mm) {
  MachineDesign& machine = design.machine.emplace(MachineDesign{.motor = motor});
  // what is machined has fits of ISO 286
  if (design.made.process && !(design.made.process->layer_mm > 0.0)) machine.housing.fit_mm = 0.0;
  machine.fasteners = {.housing = screw_of("M3"),
                       .carrier = screw_of("M3-short"),
                       .output = screw_of("M3"),
                       .motor = screw_of(motor.screw)};
  for (GearDesign& gear : design.gears) gear.outer_diameter_mm.reset();  // the housing's
  machine.bearings = {.output = *find_element(standard_elements().bearings, "6804")};
  shaft_gear(design, machine);
  for (int turn = 0; turn < kScalings; ++turn) {
    if (design.topology.has_planets()) choose_planet_bearing(design, wall_mm);
    choose_output_bearing(design, wall_mm);
    if (!design.topology.has_planets()) choose_wheel_bearing(design, wall_mm);
    const auto train = lay_out(design);
    const auto layout = train ? machine_layout(*train) : std::nullopt;
    if (!layout) return design;
    if (thicken_plates(design, *train, *layout)) continue;
    const double over = 2.0 * layout->least_outer_radius_mm - (outer_diameter_mm - kSpare_mm);
    if (std::abs(over) < kSpare_mm) return design;
    scale(design, 1.0 - over / growing_diameter_mm(*train, *layout));
  }
  return design;
}

}  // namespace trueflank
