// SPDX-License-Identifier: GPL-3.0-or-later
//
// A gear on a round shaft is held by a set screw across its hub; on a shaft with a flat the screw
// bears on the flat, if the design wants one. In plastic the screw turns in a
// square nut, which lies in a pocket of the bore, open to the motor; the wall outside it is drilled
// through from a flat. In metal the hub itself is drilled and tapped. The housing goes over the
// gear afterwards: a key gets to the screw before that.
#include "trueflank/train/machine/set_screw.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/train/machine/layout_steps.h"

namespace trueflank {
namespace {

/// Square nuts, thin (DIN 562), and set screws with a cup point (ISO 4029) of their thread: the key
/// and the usual tightening torque.
struct SquareNut {
  const char* thread;
  double width_mm, height_mm, key_mm, torque_nm;
};
constexpr std::array<SquareNut, 3> kNuts{
    {{"M3", 5.5, 1.8, 1.5, 0.9}, {"M4", 7.0, 2.2, 2.0, 2.1}, {"M5", 8.0, 2.7, 2.5, 4.6}}};
/// Force of a tightened screw: its torque over this part of its diameter (a usual rule).
constexpr double kTorqueOfForce = 0.2;
/// Friction of screw and bore on a dry shaft, and pressure that printed plastic bears: cautious.
constexpr double kFriction = 0.15, kPressure_mpa = 30.0;
/// The same on the flat of a bore, for a while: printed, and of metal.
constexpr double kFlatPressure_mpa = 60.0, kMetalPressure_mpa = 150.0;
/// Threads by the shaft: up to 7 mm, up to 12 mm, beyond.
constexpr std::array<double, 2> kShafts_mm{7.0, 12.0};
/// Lengths of set screws that are stocked. Source: ISO 4029, preferred lengths.
constexpr std::array<double, 10> kLengths_mm{3, 4, 5, 6, 8, 10, 12, 16, 20, 25};
/// Room of a nut in its pocket, in either direction.
constexpr double kNutRoom_mm = 0.2;
/// The pocket's bore is wider than the shaft's and the nut, on the radius.
constexpr double kPocketRoom_mm = 0.1;
/// The flat is wider than the drill by this on either side.
constexpr double kBesideDrill_mm = 1.0;
/// Thread in a metal hub, of the screw's diameter.
constexpr double kThread = 1.5;
/// Hub and foot have no arc in common.
constexpr double kInsideFoot_mm = 0.05;

const SquareNut& nut_for(double shaft_mm) {
  std::size_t i = 0;
  while (i < kShafts_mm.size() && shaft_mm > kShafts_mm[i]) ++i;
  return kNuts[i];
}

const SquareNut& nut_of(const MachineLayout::SetScrew& screw) {
  return *std::find_if(kNuts.begin(), kNuts.end(),
                       [&](const SquareNut& nut) { return screw.screw.name == nut.thread; });
}

bool is_printed(const GearTrain& train) {
  const auto& process = train.design.made.process;
  return !process || process->layer_mm > 0.0;
}

/// The screw's edge stays this far on the shaft's flat.
constexpr double kOnFlat_mm = 0.3;

/// The foot round the pocket of a nut, with its flat. The screw's axis is `least_axis_mm` above the
/// hub's end at least.
void size_for_nut(const SquareNut& nut, double bore_radius_mm, double wall_mm, double least_axis_mm,
                  MachineLayout::SetScrew& s) {
  s.nut = true;
  s.pocket_width_mm = nut.width_mm + kNutRoom_mm;
  s.pocket_end_mm = bore_radius_mm + kPocketRoom_mm + nut.height_mm + kNutRoom_mm;
  s.pocket_bore_mm = std::max(2.0 * bore_radius_mm, s.pocket_width_mm) + 2.0 * kPocketRoom_mm;
  s.axis_mm = std::max(0.5 * s.pocket_width_mm, least_axis_mm);
  s.pocket = {0.0, s.axis_mm + 0.5 * s.pocket_width_mm};
  s.foot = {0.0, s.pocket.upper_mm + wall_mm};
  s.drill_mm = s.screw.hole_mm;
  s.flat_mm = std::hypot(s.pocket_end_mm, 0.5 * s.pocket_width_mm) + wall_mm;
  s.through_mm = s.flat_mm - s.pocket_end_mm;
  s.foot_radius_mm = std::hypot(s.flat_mm, 0.5 * s.drill_mm + kBesideDrill_mm);
}

/// Straight teeth that go on to the foot lie inside it, where hole and printer want that.
void widen_foot(const GearTrain& train, double hole_room_mm, const MachineLayout& m,
                MachineLayout::SetScrew& s) {
  const auto& process = train.design.made.process;
  const TrainGear& gear = train.gear(m.driven_gear);
  if (!s.nut || !process || !(process->ledge_mm > 0.0) || gear.twist.turn_rad_per_mm != 0.0) return;
  const double flat = gear.profile.tip_radius_mm() + kInsideFoot_mm;
  const double radius = std::hypot(flat, 0.5 * s.drill_mm + kBesideDrill_mm);
  const double collar = train.design.machine->motor.pilot_diameter_mm;
  const double room =
      collar > 0.0 ? std::min(hole_room_mm, 0.5 * m.fits.pilot.hole_mm(collar)) : hole_room_mm;
  if (flat <= s.flat_mm || radius + m.clearance_mm > room) return;
  s.flat_mm = flat;
  s.through_mm = flat - s.pocket_end_mm;
  s.foot_radius_mm = radius;
}

/// The foot with its thread.
void size_for_thread(double bore_radius_mm, double wall_mm, double least_axis_mm,
                     MachineLayout::SetScrew& s) {
  const double d = s.screw.diameter_mm;
  s.through_mm = std::max(kThread * d, wall_mm);
  s.foot_radius_mm = bore_radius_mm + s.through_mm;
  const double beside = 0.5 * d + std::max(wall_mm, 0.5 * d);
  s.axis_mm = std::max(beside, least_axis_mm);
  s.foot = {0.0, s.axis_mm + beside};
}

}  // namespace

std::vector<std::string> bought_for_set_screw(const MachineLayout::SetScrew& screw) {
  if (!screw.is_there()) return {};
  std::vector<std::string> all{"set screw ISO 4029 " + screw.screw.name + "x" +
                               printed_number(screw.length_mm, "%.0f")};
  if (screw.nut) all.push_back("square nut DIN 562 " + screw.screw.name);
  return all;
}

std::string set_screw_operation(const MachineLayout& layout) {
  const auto& s = layout.set_screw;
  if (!s.is_there()) return {};
  const std::string height = printed("%.2f mm from the end of the hub on the motor's side",
                                     s.axis_mm - layout.hub.lower_mm);
  if (s.nut)
    return printed(
               "Drill %.1f mm across the axis, in the middle of the hub's flat (%.2f mm from the "
               "axis), ",
               s.drill_mm, s.flat_mm) +
           height + printed(": through %.1f mm into the pocket of the nut.", s.through_mm);
  return "Drill and tap " + s.screw.name + " across the axis into " +
         (s.on_flat ? "the middle of the bore's flat, " : "the bore, ") + height + ".";
}

double set_screw_key_mm(const MachineLayout::SetScrew& screw) { return nut_of(screw).key_mm; }

double held_torque_nm(const MachineLayout::SetScrew& screw, double shaft_diameter_mm) {
  const SquareNut& nut = nut_of(screw);
  double force_n = 1000.0 * nut.torque_nm / (kTorqueOfForce * screw.screw.diameter_mm);
  if (screw.nut) {
    const double area = nut.width_mm * nut.width_mm - 0.25 * kPi * screw.drill_mm * screw.drill_mm;
    force_n = std::min(force_n, kPressure_mpa * area);
  }
  return 2.0 * kFriction * force_n * 0.5 * shaft_diameter_mm / 1000.0;
}

double flat_in_bore_mm(const MachineLayout& m) {
  return std::max(0.0, m.gripped.upper_mm - std::max(m.gripped.lower_mm, m.flat_from_mm));
}

double held_by_flat_nm(const GearTrain& train, double flat_in_bore_mm) {
  const Motor& motor = train.design.machine->motor;
  const double radius = 0.5 * motor.shaft_diameter_mm, off = motor.flat_mm - radius;
  const double half_width = std::sqrt(std::max(0.0, radius * radius - off * off));
  const double pressure = is_printed(train) ? kFlatPressure_mpa : kMetalPressure_mpa;
  return 0.5 * pressure * flat_in_bore_mm * half_width * half_width / 1000.0;
}

double room_of_hole_mm(const MachineDesign& machine, const MachineLayout& m) {
  return 0.5 * (machine.motor.bolt_circle_diameter_mm - machine.fasteners.motor.head_diameter_mm) -
         kHeadRoom_mm - m.wall_mm;
}

void plan_set_screw(const GearTrain& train, double hole_room_mm, MachineLayout& m) {
  const Motor& motor = train.design.machine->motor;
  const bool flat = motor.flat_mm > 0.0;
  const SetScrewUse use = train.design.machine->fasteners.set_screw;
  if (use == SetScrewUse::kNever || (flat && use != SetScrewUse::kAlways)) return;
  if (m.driven_gear < 0) {
    m.set_screw.missing = "no key reaches a set screw: the carrier is on the shaft";
    return;
  }
  const BoreDesign& bore = train.design.gears[static_cast<std::size_t>(m.driven_gear)].bore;
  if (bore.kind != (flat ? BoreKind::kDFlat : BoreKind::kRound) || !(bore.diameter_mm > 0.0))
    return;
  const SquareNut& nut = nut_for(motor.shaft_diameter_mm);
  MachineLayout::SetScrew s;
  s.screw = *find_element(standard_elements().screws, nut.thread);
  const double radius = 0.5 * bore.diameter_mm, shaft = 0.5 * motor.shaft_diameter_mm;
  const double from = motor.pilot_height_mm + kHubGap_mm;
  const double least_axis = flat ? motor.shaft_length_mm - motor.flat_length_mm - from +
                                       0.5 * s.screw.diameter_mm + kOnFlat_mm
                                 : 0.0;
  if (is_printed(train))
    size_for_nut(nut, radius, m.wall_mm, least_axis, s);
  else
    size_for_thread(radius, m.wall_mm, least_axis, s);
  s.on_flat = flat;
  s.bears_mm = flat ? motor.flat_mm - shaft : shaft;
  widen_foot(train, hole_room_mm, m, s);
  const auto none = [&](const std::string& why) { m.set_screw.missing = why; };
  if (train.design.herringbone)
    return none(
        "no key reaches a set screw: herringbone gears stand round this one before it goes on "
        "the shaft");
  const double tip = train.gear(m.driven_gear).profile.tip_radius_mm();
  const double hole = std::max(s.foot_radius_mm, tip) + m.clearance_mm;
  const auto mm = [](double value) { return printed("%.2f mm", value); };
  const bool centred = motor.pilot_diameter_mm > 0.0;  // by a hole that fits its collar
  if (const double collar = 0.5 * m.fits.pilot.hole_mm(motor.pilot_diameter_mm);
      centred && hole > collar)
    return none("a set screw wants a hole of radius " + mm(hole) + " in the floor, for the " +
                (tip > s.foot_radius_mm ? "gear" : "hub") +
                " to go through; that of the motor's collar has " + mm(collar));
  if (hole > hole_room_mm)
    return none("a set screw wants a hole of radius " + mm(hole) + " in the floor, for the " +
                (tip > s.foot_radius_mm ? "gear" : "hub") + " to go through; the motor's screws" +
                (m.wheel_gear >= 0 ? " and the wheel's bearing" : "") + " leave " +
                mm(std::max(0.0, hole_room_mm)));
  if (motor.shaft_length_mm < from + s.axis_mm + 0.5 * s.screw.diameter_mm)
    return none("the motor's shaft is too short to reach a set screw " + mm(from + s.axis_mm) +
                " above the motor's face");
  const double outside = s.nut ? s.flat_mm : s.foot_radius_mm;
  for (const double length : kLengths_mm)
    if (length <= outside - s.bears_mm) s.length_mm = length;
  m.set_screw = s;
}

double floor_of_set_screw_mm(const Motor& motor, const MachineLayout& m) {
  if (!m.set_screw.is_there()) return 0.0;
  return motor.pilot_height_mm + kHubGap_mm + m.set_screw.foot.upper_mm;
}

void place_set_screw(const GearTrain& train, MachineLayout& m) {
  const Motor& motor = train.design.machine->motor;
  auto& s = m.set_screw;
  if (s.is_there()) {
    for (HeightRange* range : {&s.foot, &s.pocket})
      *range = {range->lower_mm + m.hub.lower_mm, range->upper_mm + m.hub.lower_mm};
    s.axis_mm += m.hub.lower_mm;
    const auto& process = train.design.made.process;
    const TrainGear& gear = train.gear(m.driven_gear);
    m.toothed_hub = process && process->ledge_mm > 0.0 && gear.twist.turn_rad_per_mm == 0.0 &&
                    gear.profile.tip_radius_mm() + 0.5 * kInsideFoot_mm <=
                        (s.nut ? s.flat_mm : s.foot_radius_mm);
    m.hub_radius_mm =
        std::min(m.hub_radius_mm, (s.nut ? s.flat_mm : s.foot_radius_mm) - kInsideFoot_mm);
  }
  const double hub = std::max(m.hub_radius_mm, 0.5 * motor.shaft_diameter_mm) + m.clearance_mm;
  m.floor_hole_radius_mm = std::max(0.5 * m.fits.pilot.hole_mm(motor.pilot_diameter_mm), hub);
  if (s.is_there())
    m.floor_hole_radius_mm =
        std::max(m.floor_hole_radius_mm,
                 std::max(s.foot_radius_mm, train.gear(m.driven_gear).profile.tip_radius_mm()) +
                     m.clearance_mm);
}

}  // namespace trueflank
