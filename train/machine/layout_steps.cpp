// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/layout_steps.h"

#include <algorithm>

namespace trueflank {
namespace {

/// The bearing's rings are touched up to this part of the ring section's height.
constexpr double kShoulder = 0.1;
constexpr int kRetainerScrews = 4;
/// Rim of a ring that drives out, of the module, and at least in mm.
constexpr double kRim = 2.5, kLeastRim_mm = 2.0;
/// A disc is this much thicker than the inserts in it are long.
constexpr double kInsertCover_mm = 0.3;

void place_output_screws(const MachineDesign& machine, double head_mm, MachineLayout& m) {
  const Screw& screw = machine.fasteners.output;
  const int bolts = machine.output.bolts;
  const double circle = machine.output.bolt_circle_diameter_mm
                            ? 0.5 * *machine.output.bolt_circle_diameter_mm
                            : m.journal_radius_mm - m.wall_mm - 0.5 * screw.hole_mm;
  m.load_inserts = on_circle(circle, bolts, kPi / bolts);
  const double head = m.plate.upper_mm - head_mm;
  m.output_screws = with_length({.what = "output",
                                 .screw = screw,
                                 .at = on_circle(circle, bolts, 0.0),
                                 .axis = m.output_axis,
                                 .head_mm = head,
                                 .way = -1.0,
                                 .far_mm = m.disc.lower_mm},
                                head - m.disc.upper_mm,
                                std::max(0.0, head - m.plate.lower_mm));
}

void place_retainer(const MachineDesign& machine, double head_mm, MachineLayout& m) {
  const Screw& screw = machine.fasteners.output;
  const double circle =
      0.5 * (m.fits.output.hole_mm(machine.bearings.output.outer_mm) + screw.insert_hole_mm) + m.wall_mm;
  m.retainer_radius_mm = circle + 0.5 * screw.head_diameter_mm + m.wall_mm + kHeadCover_mm;
  const double head = m.retainer.lower_mm + head_mm;
  m.retainer_screws = with_length({.what = "retainer",
                                   .screw = screw,
                                   .at = on_circle(circle, kRetainerScrews, kPi / kRetainerScrews),
                                   .axis = m.output_axis,
                                   .head_mm = head,
                                   .way = 1.0,
                                   .far_mm = m.roof.upper_mm},
                                  m.roof.lower_mm - head, 0.0);
}

}  // namespace

Shoulders shoulders_of(const Bearing& bearing) {
  const double shoulder = kShoulder * (bearing.outer_mm - bearing.bore_mm);
  return {.inner_mm = 0.5 * bearing.bore_mm + shoulder, .outer_mm = 0.5 * bearing.outer_mm - shoulder};
}

void settle_walls(const GearboxDesign& design, MachineLayout& m) {
  const HousingDesign& housing = design.machine->housing;
  const double least = design.made.process ? design.made.process->least_wall_mm : 0.0;
  m.wall_mm = housing.wall_mm.value_or(std::max(1.2, 1.5 * least));
  m.fits = seat_fits(*design.machine);
  m.fit_mm = m.fits.ring.hole.empty() ? housing.fit_mm : 0.0;
  m.clearance_mm = housing.clearance_mm;
}

void place_floor(const MachineDesign& machine, double cavity_mm, double least_mm,
                 MachineLayout& m) {
  const Motor& motor = machine.motor;
  const Screw& screw = machine.fasteners.motor;
  double over = head_depth_mm(screw), under = under_head_mm(screw, m.wall_mm);
  if (machine.housing.floor_mm) under = *machine.housing.floor_mm - over;
  ScrewGroup& group = m.motor_screws;
  group = {.what = "motor",
           .screw = screw,
           .at = on_circle(0.5 * motor.bolt_circle_diameter_mm, motor.bolt_count,
                           kPi / motor.bolt_count),
           .way = -1.0};
  // into the motor's threads, a diameter deep at least; or through its flange, for nuts
  const bool threads = motor.thread_depth_mm > 0.0;
  const double least = threads ? screw.diameter_mm : motor.flange_mm + screw.nut_height_mm;
  const double most = threads ? motor.thread_depth_mm : least + 3.0 * screw.diameter_mm;
  for (const double length : screw.lengths_mm()) {
    if (length < under + least) continue;
    group.length_mm = length;
    if (length > under + most && !machine.housing.floor_mm) under = length - most;
    if (length > under + most) group.length_mm = 0.0;
    break;
  }
  group.shortest_mm = under + least;
  group.longest_mm = under + most;
  over = std::max(over, least_mm - under);
  m.floor = {cavity_mm - over - under, cavity_mm};
  group.head_mm = cavity_mm - over;
  group.far_mm = m.floor.lower_mm;
}

void place_shaft(const Motor& motor, MachineLayout& m) {
  const double face = m.floor.lower_mm;
  m.shaft_end_mm = face + motor.shaft_length_mm;
  m.flat_from_mm = motor.flat_mm > 0.0 ? m.shaft_end_mm - motor.flat_length_mm : face;
  m.hub_radius_mm = 0.5 * motor.shaft_diameter_mm + std::max(2.0 * m.wall_mm, 2.0);
  m.hub_room_mm = kNoPlanet_mm;
}

void widen_hub(const TrainGear& gear, const MachineDesign& machine, MachineLayout& m) {
  const double heads = 0.5 * (machine.motor.bolt_circle_diameter_mm -
                              machine.fasteners.motor.head_diameter_mm) -
                       2.0 * m.clearance_mm - m.wall_mm;
  m.hub_radius_mm =
      std::min(gear.profile.root_radius_mm() - kHubInset * gear.profile.gear().normal_module_mm,
               std::max(m.hub_radius_mm, heads));
}

void place_cup(const TrainGear& ring, const Screw& output, double disc_mm, MachineLayout& m) {
  m.cup_radius_mm = ring.profile.root_radius_mm() +
                    std::max(kRim * ring.profile.gear().normal_module_mm, kLeastRim_mm);
  m.disc = {disc_mm, disc_mm + std::max(output.insert_length_mm + kInsertCover_mm, 2.0 * m.wall_mm)};
}

void place_output(const MachineDesign& machine, MachineLayout& m) {
  const Screw& screw = machine.fasteners.output;
  const Bearing& bearing = machine.bearings.output;
  const double head = head_depth_mm(screw), under = under_head_mm(screw, m.wall_mm);
  m.retainer.lower_mm = m.disc.upper_mm + m.clearance_mm;
  m.retainer.upper_mm = m.retainer.lower_mm + head + under;
  m.bearings = {m.retainer.upper_mm,
                m.retainer.upper_mm + machine.bearings.outputs * bearing.width_mm};
  m.journal_radius_mm = 0.5 * m.fits.output.shaft_mm(bearing.bore_mm);
  const Shoulders shoulders = shoulders_of(bearing);
  m.inner_shoulder_mm = shoulders.inner_mm;
  m.outer_shoulder_mm = shoulders.outer_mm;
  m.roof = {m.bearings.lower_mm, m.bearings.upper_mm + std::max(2.0, m.wall_mm)};
  m.plate.lower_mm = m.roof.upper_mm + m.clearance_mm;
  m.plate.upper_mm = m.plate.lower_mm + head + under;
  m.plate_radius_mm = 0.5 * bearing.outer_mm;
  place_output_screws(machine, head, m);
  place_retainer(machine, head, m);
}

}  // namespace trueflank
