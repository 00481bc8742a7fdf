// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/machine_contradictions.h"

#include <cmath>
#include <optional>

#include "trueflank/design/key_rule.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

class MachineContradictions {
 public:
  MachineContradictions(const GearboxDesign& design, bool kind_known, Reading& reading)
      : design_(design), kind_known_(kind_known), reading_(reading) {}

  void report() {
    const Topology& topology = design_.topology;
    if (kind_known_) check_housed(topology);
    check_motor(design_.machine->motor);
    check_fits(*design_.machine);
    for (const GearDesign& gear : design_.gears)
      if (gear.kind == GearKind::kInternal)
        for (const char* name : {"outer_diameter_mm", "bolt_circle_diameter_mm"})
          if (reading_.has(gear.name + "." + name))
            reading_.contradiction(gear.name + "." + name, "follows from [housing]",
                                   "outer_diameter_mm in [housing], or nothing");
    if (reading_.has("carrier.bearing_diameter_mm"))
      reading_.contradiction("carrier.bearing_diameter_mm",
                             "the carrier of a gearbox has no such seat",
                             "[bearings], or no [housing]");
  }

 private:
  /// Which trains a housing is made for, and what of its keys they have.
  void check_housed(const Topology& topology) {
    if (topology.stage_count() > 1)
      return reading_.contradiction("housing", "no housing is made for several stages",
                                    "another kind, or no [housing]; [carrier] makes plates and pins");
    if (!has_housing(topology))
      return reading_.contradiction("housing", "no housing is made for a single gear",
                                    "another kind, or no [housing]");
    const bool pair = !topology.has_planets();
    if (reading_.has(pair ? "bearings.planet" : "bearings.wheel"))
      reading_.contradiction(pair ? "bearings.planet" : "bearings.wheel",
                             pair ? "a pair has no planets" : "only a pair has a wheel",
                             pair ? "bearings.wheel, or nothing" : "bearings.planet, or nothing");
    if (!pair) return;
    const GearDesign& wheel = design_.gears.back();
    if (wheel.kind == GearKind::kInternal && reading_.has("bearings.wheel"))
      reading_.contradiction("bearings.wheel",
                             "a wheel with inner teeth has its pinion where that would be",
                             "outputs = 2, or crossed rollers for bearings.output");
    if (reading_.has(wheel.name + ".bore_mm") || reading_.has(wheel.name + ".bore_hex_mm"))
      reading_.contradiction(
          wheel.name + (reading_.has(wheel.name + ".bore_mm") ? ".bore_mm" : ".bore_hex_mm"),
          "the wheel of a gearbox turns on a journal of its own", "no bore, or no [housing]");
  }

  /// Classes of ISO 286; where something bought goes in, that of the hole alone.
  void check_fits(const MachineDesign& machine) {
    const HousingDesign& housing = machine.housing;
    const BearingsDesign& bearings = machine.bearings;
    check_fit("housing.fit", housing.fit);
    check_fit("housing.ring_fit", housing.ring_fit);
    check_fit("bearings.output_fit", bearings.output_fit);
    check_fit("bearings.wheel_fit", bearings.wheel_fit);
    check_hole("housing.shaft_fit", housing.shaft_fit);
    check_hole("housing.pilot_fit", housing.pilot_fit);
    check_hole("housing.pin_fit", housing.pin_fit);
    check_hole("bearings.planet_fit", bearings.planet_fit);
    if (bearings.planet_fit && !bearings.planet)
      reading_.contradiction("bearings.planet_fit", "there is no bearing in the planets",
                             "bearings.planet, or nothing");
    if (bearings.wheel_fit && !bearings.wheel)
      reading_.contradiction("bearings.wheel_fit", "there is no bearing under a wheel",
                             "bearings.wheel, or nothing");
  }
  bool check_fit(const char* key, const std::optional<FitClasses>& fit) {
    if (!fit || fit_classes(fit->text())) return fit.has_value();
    reading_.report(
        {.code = ErrorCode::kOutOfRange,
         .message = "names no classes of ISO 286",
         .key = key,
         .remedy = "a hole and a shaft as \"H7/k6\", or one of them; letters d e f g h js j k m "
                   "n p r s, grades 4 to 12"});
    return false;
  }
  void check_hole(const char* key, const std::optional<FitClasses>& fit) {
    if (check_fit(key, fit) && !fit->shaft.empty())
      reading_.contradiction(key, "what goes into this hole is bought and has no class to choose",
                             "the class of the hole alone, as \"H7\"");
  }

  void check_motor(const Motor& motor) {
    if (!reading_.has("motor"))
      return reading_.missing("motor", "the table is missing, and [housing] needs it",
                              "[motor] with name, or with its numbers");
    const std::pair<const char*, double> needed[] = {
        {"shaft_diameter_mm", motor.shaft_diameter_mm},
        {"shaft_length_mm", motor.shaft_length_mm},
        {"bolt_circle_diameter_mm", motor.bolt_circle_diameter_mm}};
    const bool named = reading_.has("motor.name");
    for (const auto& [name, value] : needed)
      if (!named && !(value > 0.0))
        reading_.missing(std::string("motor.") + name, "missing, and the motor has no name",
                         "a length above 0, or name");
    if (!(motor.shaft_diameter_mm > 0.0 && motor.flat_mm > 0.0)) return;
    if (!(motor.flat_mm > 0.5 * motor.shaft_diameter_mm && motor.flat_mm < motor.shaft_diameter_mm))
      reading_.contradiction("motor.flat_mm",
                             "is no flat of a shaft of " + plain_mm(motor.shaft_diameter_mm),
                             "more than " + plain_mm(0.5 * motor.shaft_diameter_mm) + ", less than " +
                                 plain_mm(motor.shaft_diameter_mm));
  }

  const GearboxDesign& design_;
  bool kind_known_;
  Reading& reading_;
};

}  // namespace

void report_machine_contradictions(const GearboxDesign& design, bool kind_known, Reading& reading) {
  MachineContradictions(design, kind_known, reading).report();
}

}  // namespace trueflank
