// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_bearings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/check/machine/machine_loads.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Between the seats of a planet's two bearings.
constexpr double kBetweenSeats_mm = 1.0;

Findings bearing_seats(const GearTrain& train, const MachineLayout& m) {
  Findings findings;
  const auto& planet = train.design.machine->bearings.planet;
  if (planet) {
    double top = -1e300, bottom = 1e300;
    for (std::size_t i = 0; i < train.gears.size(); ++i) {
      if (!train.topology().is_planet_gear(i)) continue;
      top = std::max(top, train.gears[i].z_lower_mm + train.gears[i].face_width_mm);
      bottom = std::min(bottom, train.gears[i].z_lower_mm);
    }
    const double room = top - bottom - kBetweenSeats_mm, wanted = 2.0 * planet->width_mm;
    findings.push_back(judged(
        {.id = "bearing_seat",
         .where = "planet",
         .value = room,
         .limit = wanted,
         .unit = "mm",
         .message = "two bearings " + planet->name + " are " + mm_text(wanted) +
                    " wide, the planet has " + mm_text(room) + " for them",
         .cure = "wider gears, or a narrower bearing"},
        wanted));
  }
  if (const auto& wheel = train.design.machine->bearings.wheel) {
    const double inserts = m.output_screws.at.front().norm() - 0.5 * m.output_screws.screw.insert_hole_mm;
    findings.push_back(judged(
        {.id = "bearing_seat",
         .where = "wheel",
         .value = inserts,
         .limit = m.stub.inner_shoulder_mm,
         .unit = "mm",
         .message = "the wheel's shoulder on bearing " + wheel->name + " reaches radius " +
                    mm_text(m.stub.inner_shoulder_mm) + ", the inserts of the output's screws begin at " +
                    mm_text(inserts),
         .cure = "a smaller bearings.wheel, or a larger bearings.output"},
        m.stub.inner_shoulder_mm));
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

/// Forces across the wheel's axis of a pair: where along it, and how large. Their directions are taken
/// as the worst.
struct AcrossForce {
  double at_mm = 0.0, force_n = 0.0;
};

/// On the nearer of two supports, by the lever.
double support_n(const std::vector<AcrossForce>& forces, double here_mm, double other_mm) {
  double sum = 0.0;
  for (const AcrossForce& f : forces)
    sum += f.force_n * std::abs(other_mm - f.at_mm) / std::abs(other_mm - here_mm);
  return sum;
}

/// The wheel between a bearing in the floor and the output's in the lid; without the first, in the
/// output's alone.
Findings wheel_bearing_loads(const GearTrain& train, const MachineLayout& m) {
  const MachineDesign& machine = *train.design.machine;
  const BearingsDesign& bearings = machine.bearings;
  const WheelForces gear = wheel_forces(train, machine_loads(train).output_torque_nm);
  const double width = bearings.output.width_mm;
  const TrainGear& wheel = train.gear(m.wheel_gear);
  const double middle = wheel.z_lower_mm + 0.5 * wheel.face_width_mm;
  const double lid = 0.5 * (m.bearings.lower_mm + m.bearings.upper_mm);
  const std::vector<AcrossForce> forces{{middle, gear.across_n},
                                        {m.plate.upper_mm, machine.output.radial_load_n}};
  BearingLoad load{.axial_n = machine.output.axial_load_n + gear.along_n,
                   .speed_rpm = machine.output.speed_rpm};
  const auto life = [&](const char* where, const Bearing& bearing) {
    return judge_life(where, bearing, load, bearings.life_h);
  };
  if (bearings.wheel) {
    const double floor = 0.5 * (m.stub.bearing.lower_mm + m.stub.bearing.upper_mm);
    const double couple_n = gear.tilting_nmm / (lid - floor);
    load.radial_n = (support_n(forces, lid, floor) + couple_n) / bearings.outputs;
    Findings findings{life("output", bearings.output)};
    load.radial_n = support_n(forces, floor, lid) + couple_n;
    load.axial_n = 0.0;
    findings.push_back(life("wheel", *bearings.wheel));
    return findings;
  }
  if (bearings.outputs > 1) {
    const double first = m.bearings.lower_mm + 0.5 * width, last = m.bearings.upper_mm - 0.5 * width;
    load.radial_n = std::max(support_n(forces, first, last), support_n(forces, last, first)) +
                    gear.tilting_nmm / (last - first);
    return {life("output", bearings.output)};
  }
  load.tilting_nmm = gear.tilting_nmm;
  for (const AcrossForce& f : forces) {
    load.radial_n += f.force_n;
    load.tilting_nmm += f.force_n * std::abs(f.at_mm - lid);
  }
  Findings findings{life("output", bearings.output)};
  if (bearings.output.kind != BearingKind::kCrossedRollers) {
    findings.back().status = std::max(findings.back().status, CheckStatus::kWarn);
    const std::string under = m.cup_radius_mm > 0.0 ? "crossed rollers, or outputs = 2 in [bearings]: "
                                                    : "bearings.wheel, in the floor under the wheel; or "
                                                      "outputs = 2 in [bearings]: ";
    findings.back().cure = under + "one ball bearing alone holds no tilting load";
  }
  return findings;
}

Findings bearing_loads(const GearTrain& train, const MachineLayout& m) {
  const MachineDesign& machine = *train.design.machine;
  const double wanted = machine.bearings.life_h;
  if (m.wheel_gear >= 0) return wheel_bearing_loads(train, m);
  Findings findings{judge_life("output", machine.bearings.output, output_load(machine, m), wanted)};
  if (machine.output.radial_load_n > 0.0 && machine.bearings.outputs == 1 &&
      machine.bearings.output.kind != BearingKind::kCrossedRollers) {
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

}  // namespace

Findings check_bearings(const GearTrain& train, const MachineLayout& layout) {
  Findings all = bearing_seats(train, layout);
  for (Finding& finding : bearing_loads(train, layout)) all.push_back(std::move(finding));
  return all;
}

}  // namespace trueflank
