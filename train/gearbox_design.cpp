// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/gearbox_design.h"

#include <algorithm>

#include "trueflank/train/machine/seat_fits.h"

namespace trueflank {
namespace {

/// nullptr for the first.
const StageDesign* later_stage(const GearboxDesign& design, int stage) {
  const auto index = static_cast<std::size_t>(stage - 2);
  return stage >= 2 && index < design.later_stages.size() ? &design.later_stages[index] : nullptr;
}

}  // namespace

const GearDesign* find_gear(const GearboxDesign& design, const std::string& name) {
  const auto it = std::find_if(design.gears.begin(), design.gears.end(),
                               [&](const GearDesign& gear) { return gear.name == name; });
  return it == design.gears.end() ? nullptr : &*it;
}

const GearDesign* planet_with_bore(const GearboxDesign& design) {
  const int planet = design.topology.first_planet();
  return planet == kNoMember
             ? nullptr
             : &design.gears[static_cast<std::size_t>(design.topology.first_gear_of(planet))];
}

const GearDesign& first_of_body(const GearboxDesign& design, std::size_t gear) {
  const int member = design.topology.gears[gear].member;
  return design.gears[static_cast<std::size_t>(design.topology.first_gear_of(member))];
}

BoreDesign shaft_bore(const MachineDesign& machine) {
  const Motor& motor = machine.motor;
  BoreDesign bore{.diameter_mm = seat_fits(machine).shaft.hole_mm(motor.shaft_diameter_mm)};
  if (motor.flat_mm > 0.0) {
    bore.kind = BoreKind::kDFlat;
    bore.d_flat_mm = motor.flat_mm + bore.diameter_mm - motor.shaft_diameter_mm;
  }
  return bore;
}

double bore_between(const Bearing& bearing) {
  // a shoulder of about a third of the ring's height: the inner ring stays free of it
  return bearing.bore_mm + 0.65 * (bearing.outer_mm - bearing.bore_mm);
}

double module_of(const GearboxDesign& design, const GearDesign& gear) {
  if (gear.module_mm) return *gear.module_mm;
  const int index = design.later_stages.empty() ? -1 : design.topology.find_gear(gear.name);
  const StageDesign* stage = index < 0 ? nullptr : later_stage(design, design.topology.gears[static_cast<std::size_t>(index)].stage);
  return stage ? stage->module_mm.value_or(design.module_mm) : design.module_mm;
}

int planets_of(const GearboxDesign& design, int member) {
  const Topology& topology = design.topology;
  if (!topology.is_planet(member)) return 1;
  const int gear = topology.first_gear_of(member);
  const StageDesign* stage = later_stage(design, topology.gears[static_cast<std::size_t>(gear)].stage);
  return stage ? stage->planets : design.planets;
}

/// In a housing the ring that drives out is one part with its cup.
bool is_made_in_halves(const GearboxDesign& design, const GearDesign& gear) {
  if (!design.herringbone || gear.kind != GearKind::kInternal) return false;
  if (!design.machine) return gear.halves.value_or(false);
  const int index = design.topology.find_gear(gear.name);
  const bool drives_out = index >= 0 && design.topology.gears[static_cast<std::size_t>(index)].member ==
                                            design.topology.output;
  return !drives_out && gear.halves.value_or(true);
}

}  // namespace trueflank
