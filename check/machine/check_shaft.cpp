// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_shaft.h"

#include <algorithm>

#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {
namespace {

/// A hub holds a shaft over one and a half of its diameters, over one at least (a rule of thumb).
constexpr double kGrip = 1.5, kLeastGrip = 1.0;

/// A set screw slips where the motor is stronger than its friction.
Finding held_by_screw(const GearTrain& train, const MachineLayout& m, Finding finding) {
  const Motor& motor = train.design.machine->motor;
  const double holds = held_torque_nm(m.set_screw, motor.shaft_diameter_mm);
  finding.message += "; " + bought_for_set_screw(m.set_screw).front() + " holds about " +
                     number_text(holds, 2) + " N m";
  if (!(motor.torque_nm > holds)) return finding;
  finding.status = CheckStatus::kWarn;
  finding.message += ", the motor has " + number_text(motor.torque_nm, 2) + " N m";
  finding.cure =
      "a flat filed on the shaft under the screw, retaining compound besides, or flat_mm and "
      "flat_length_mm in [motor]";
  return finding;
}

/// A flat digs into a bore where the motor is stronger than that bears.
Finding held_by_flat(const GearTrain& train, const MachineLayout& m, Finding finding) {
  const Motor& motor = train.design.machine->motor;
  const double holds = held_by_flat_nm(train, flat_in_bore_mm(m));
  finding.message += "; its flat holds about " + number_text(holds, 2) + " N m";
  if (!(motor.torque_nm > holds)) return finding;
  finding.status = CheckStatus::kWarn;
  finding.message += ", the motor has " + number_text(motor.torque_nm, 2) + " N m";
  finding.cure =
      std::string(m.driven_gear < 0 ? "a thicker plate_thickness_mm in [carrier]"
                                    : "a wider face_width_mm, as far as the flat goes") +
      ", a longer flat (flat_length_mm in [motor]), less torque of the motor (torque_nm), "
      "or a process that makes the part of metal";
  return finding;
}

/// On a flat a screw takes the play; the torque is the flat's to carry.
Finding on_the_flat(const GearTrain& train, const MachineLayout& m, Finding finding) {
  const double from = m.set_screw.axis_mm - 0.5 * m.set_screw.screw.diameter_mm - m.flat_from_mm;
  finding.message += "; " + bought_for_set_screw(m.set_screw).front() + " bears on its flat, " +
                     mm_text(from) + " from where that begins, and keeps the " +
                     train.topology().name_of(train.topology().input) + " in its place";
  return finding;
}

}  // namespace

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
  const double fitted_mm = m.fits.shaft.hole_mm(motor.shaft_diameter_mm);
  const bool pressed_on =
      gear && fitted_mm <= motor.shaft_diameter_mm && gear->bore.diameter_mm >= fitted_mm;
  if (gear && !pressed_on && !(gear->bore.diameter_mm > motor.shaft_diameter_mm)) {
    finding.status = CheckStatus::kFail;
    finding.message = "the motor's shaft of " + mm_text(motor.shaft_diameter_mm) +
                      " does not go into the bore of " + mm_text(gear->bore.diameter_mm);
    finding.cure = "bore_mm in [" + gear->name + "] of more, or none: it follows from the shaft";
  }
  if (finding.status != CheckStatus::kFail && m.set_screw.is_there())
    return motor.flat_mm > 0.0 ? held_by_flat(train, m, on_the_flat(train, m, std::move(finding)))
                               : held_by_screw(train, m, std::move(finding));
  if (finding.status != CheckStatus::kFail && motor.flat_mm > 0.0)
    finding = held_by_flat(train, m, std::move(finding));
  if (finding.status != CheckStatus::kFail && !m.set_screw.missing.empty() && motor.flat_mm > 0.0) {
    finding.status = CheckStatus::kWarn;
    finding.message += "; no set screw on its flat: " + m.set_screw.missing;
    finding.cure = "set_screw = \"round\" in [fasteners]: the flat carries the torque without it";
  }
  const BoreDesign bore = gear ? gear->bore : shaft_bore(*train.design.machine);
  if (finding.status != CheckStatus::kFail && bore.kind == BoreKind::kRound) {
    finding.status = CheckStatus::kWarn;
    finding.message += "; bore and shaft are round: glue alone carries the torque";
    if (!m.set_screw.missing.empty()) finding.message += "; " + m.set_screw.missing;
    finding.cure =
        "a flat filed on the shaft, and flat_mm and flat_length_mm in [motor]; or retaining "
        "compound";
  }
  return finding;
}

}  // namespace trueflank
