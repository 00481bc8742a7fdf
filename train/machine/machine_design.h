// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/train/machine/elements.h"
#include "trueflank/train/machine/fit_class.h"

// What makes a machine of the gears, as its author writes it (docs/gearbox.md).
namespace trueflank {

/// The cup that holds the fixed ring, and the lid on it.
struct HousingDesign {
  std::optional<double> outer_diameter_mm = {};  ///< omitted: the smallest that holds everything
  std::optional<double> wall_mm = {};  ///< omitted: one and a half of the process's least, 1.2 mm at least
  std::optional<double> floor_mm = {};  ///< omitted: as the motor's screws want it
  double clearance_mm = 0.5;  ///< between what turns and what does not
  double fit_mm = 0.1;        ///< diametral, of every seat: bearings, ring, pins, shaft
  std::optional<FitClasses> fit = {};  ///< of every seat but the pins', instead of fit_mm
  /// Of one seat, instead of both: the bore on the motor's shaft, the hole for its collar, the fixed
  /// ring in housing and lid (of a pair the lid in the housing), the planets' pins in the plates.
  std::optional<FitClasses> shaft_fit = {}, pilot_fit = {}, ring_fit = {}, pin_fit = {};
  int screws = 6;

  bool operator==(const HousingDesign&) const = default;
};

/// What the machine drives, and where that is screwed on.
struct OutputDesign {
  std::optional<double> bolt_circle_diameter_mm = {};  ///< omitted: that of the output's own screws
  int bolts = 4;  ///< as many as the output's own screws, between them
  std::optional<double> torque_nm = {};  ///< omitted: the motor's through the gears
  double speed_rpm = 10.0;
  double radial_load_n = 0.0, axial_load_n = 0.0;  ///< of the load, at the output's face

  bool operator==(const OutputDesign&) const = default;
};

struct BearingsDesign {
  Bearing output = {};
  int outputs = 1;  ///< side by side
  std::optional<Bearing> planet = {};  ///< two in every planet; none: the planet turns on its pin
  std::optional<Bearing> wheel = {};   ///< of a pair, in the floor under the wheel; none: the output's alone hold it
  double life_h = 1000.0;              ///< wanted of every bearing
  /// Seat and journal of one of them, instead of the housing's fit.
  std::optional<FitClasses> output_fit = {}, planet_fit = {}, wheel_fit = {};

  bool operator==(const BearingsDesign&) const = default;
};

/// Where the gear on the motor's shaft gets a set screw.
enum class SetScrewUse { kRoundShafts, kAlways, kNever };

struct FastenersDesign {
  Screw housing = {};  ///< through lid and ring into the housing
  Screw carrier = {};  ///< through the pillars
  Screw output = {};   ///< of the output, the retainer of its bearing, and the load
  Screw motor = {};    ///< the motor's own
  SetScrewUse set_screw = SetScrewUse::kRoundShafts;

  bool operator==(const FastenersDesign&) const = default;
};

struct MachineDesign {
  Motor motor = {};
  HousingDesign housing = {};
  OutputDesign output = {};
  BearingsDesign bearings = {};
  FastenersDesign fasteners = {};

  bool operator==(const MachineDesign&) const = default;
};

/// The bore of a planet between the seats of its bearings: their outer rings have a shoulder there.
[[nodiscard]] double bore_between(const Bearing& bearing);

}  // namespace trueflank
