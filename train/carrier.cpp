// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/carrier.h"

#include <algorithm>

#include "trueflank/train/machine/seat_fits.h"

namespace trueflank {
namespace {

/// Material around the pins of a plate without an outer diameter, of the pin's diameter.
constexpr double kRimOfPins = 0.75;
/// A plate is this much thicker than the inserts in it are long.
constexpr double kInsertCover_mm = 0.3;
/// Plates turn this part of the module inside the tips of the rings, and the clearance.
constexpr double kInsideTips = 0.1;

/// Heights of the planets' bodies.
HeightRange planet_heights(const GearTrain& train) {
  HeightRange range{1e300, -1e300};
  for (std::size_t i = 0; i < train.gears.size(); ++i) {
    const TrainGear& gear = train.gears[i];
    if (!train.topology().is_planet_gear(i)) continue;
    range.lower_mm = std::min(range.lower_mm, gear.z_lower_mm);
    range.upper_mm = std::max(range.upper_mm, gear.z_lower_mm + gear.face_width_mm);
  }
  return range;
}

/// The plates of a gearbox hold heads and inserts of its screws, and turn inside its rings.
CarrierDesign carrier_of_machine(const GearTrain& train, const MachineDesign& machine) {
  const Screw& screw = machine.fasteners.carrier;
  const double inserts =
      std::max(screw.insert_length_mm, machine.fasteners.output.insert_length_mm) + kInsertCover_mm;
  CarrierDesign design = train.design.carrier.value_or(CarrierDesign{
      .plate_thickness_mm = std::max(inserts, 2.0 * screw.head_height_mm),
      .pin_hole_clearance_mm = std::max(machine.housing.fit_mm, CarrierDesign{}.pin_hole_clearance_mm)});
  if (!design.pin_diameter_mm && machine.bearings.planet)
    design.pin_diameter_mm = machine.bearings.planet->bore_mm;
  double tip = 1e300;
  for (const TrainGear& gear : train.gears)
    if (gear.profile.gear().kind == GearKind::kInternal)
      tip = std::min(tip, gear.profile.tip_radius_mm() -
                              kInsideTips * gear.profile.gear().normal_module_mm);
  if (!design.outer_diameter_mm) design.outer_diameter_mm = 2.0 * (tip - machine.housing.clearance_mm);
  return design;
}

std::optional<CarrierDesign> carrier_design(const GearTrain& train) {
  if (!train.design.machine) return train.design.carrier;
  return carrier_of_machine(train, *train.design.machine);
}

}  // namespace

std::optional<CarrierLayout> carrier_layout(const GearTrain& train) {
  const auto design = carrier_design(train);
  const GearDesign* planet = planet_with_bore(train.design);
  if (!design || !planet) return std::nullopt;
  CarrierLayout layout;
  layout.pin_diameter_mm =
      design->pin_diameter_mm.value_or(planet->bore.diameter_mm - design->pin_clearance_mm);
  layout.pin_hole_diameter_mm = layout.pin_diameter_mm + design->pin_hole_clearance_mm;
  if (train.design.machine)
    if (const SeatFit pin = seat_fits(*train.design.machine).pin; !pin.hole.empty())
      layout.pin_hole_diameter_mm = pin.hole_mm(layout.pin_diameter_mm);
  layout.outer_diameter_mm = design->outer_diameter_mm.value_or(
      2.0 * train.centre_distance_mm + (1.0 + 2.0 * kRimOfPins) * layout.pin_diameter_mm);
  const TrainGear* sun = train.sun();
  layout.opening_diameter_mm = design->opening_diameter_mm.value_or(
      sun ? 2.0 * (sun->profile.tip_radius_mm() + design->axial_clearance_mm) : 0.0);
  layout.seat_diameter_mm = design->bearing_diameter_mm;
  layout.seat_depth_mm = design->bearing_width_mm;
  const HeightRange planets = planet_heights(train);
  const double thickness = design->plate_thickness_mm;
  layout.lower_plate.upper_mm = planets.lower_mm - design->axial_clearance_mm;
  layout.lower_plate.lower_mm = layout.lower_plate.upper_mm - thickness;
  layout.upper_plate.lower_mm = planets.upper_mm + design->axial_clearance_mm;
  layout.upper_plate.upper_mm = layout.upper_plate.lower_mm + thickness;
  return layout;
}

}  // namespace trueflank
