// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/fitted_sizes.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/train/carrier.h"
#include "trueflank/train/machine/fit_class.h"
#include "trueflank/train/machine/machine_layout.h"
#include "trueflank/train/machine/seat_fits.h"

namespace trueflank::io {
namespace {

constexpr const char* kPinClass =
    "h6";  // of pins that are made: bearings and bores of planets slide onto them

}  // namespace

FittedSizes::FittedSizes(const GearTrain& train) : made_(workmanship(train)) {
  if (train.design.machine) add_machine(train);
  add_carrier(train);
}

void FittedSizes::add_machine(const GearTrain& train) {
  const MachineDesign& machine = *train.design.machine;
  const auto add = [&](double nominal_mm, double made_mm, bool hole, const std::string& grade) {
    if (!(nominal_mm > 0.0)) return;
    // with a clearance of its own the size is drawn as it is made
    sizes_.push_back({made_mm, grade.empty() ? made_mm : nominal_mm, hole,
                      !grade.empty() ? grade
                      : hole         ? kSeatClass
                                     : kJournalClass});
  };
  const auto seat = [&](const SeatFit& fit, double size_mm) {
    add(size_mm, fit.hole_mm(size_mm), true, fit.hole);
  };
  const auto journal = [&](const SeatFit& fit, double size_mm) {
    add(size_mm, fit.shaft_mm(size_mm), false, fit.shaft);
  };
  const SeatFits fits = seat_fits(machine);
  const BearingsDesign& bearings = machine.bearings;
  seat(fits.shaft, machine.motor.shaft_diameter_mm);
  seat(fits.pilot, machine.motor.pilot_diameter_mm);
  seat(fits.output, bearings.output.outer_mm);
  journal(fits.output, bearings.output.bore_mm);
  if (bearings.planet) seat(fits.planet, bearings.planet->outer_mm);
  if (bearings.wheel) {
    seat(fits.wheel, bearings.wheel->outer_mm);
    journal(fits.wheel, bearings.wheel->bore_mm);
  }
  const auto layout = machine_layout(train);
  if (!layout) return;
  const bool pair = layout->wheel_gear >= 0;
  const SeatFit& ring = pair ? fits.rim : fits.ring;
  const double ring_mm = 2.0 * (pair ? layout->cavity_radius_mm : layout->ring_radius_mm);
  if (!ring.hole.empty()) seat(ring, ring_mm);
  if (!ring.shaft.empty()) journal(ring, ring_mm);
  if (!pair && !fits.pin.hole.empty()) seat(fits.pin, layout->carrier.pin_diameter_mm);
  if (!pair && !fits.pin.shaft.empty()) journal(fits.pin, layout->carrier.pin_diameter_mm);
}

void FittedSizes::add_carrier(const GearTrain& train) {
  std::optional<CarrierLayout> carrier;
  if (!train.design.machine)
    carrier = carrier_layout(train);
  else if (const auto layout = machine_layout(train); layout && train.topology().has_planets())
    carrier = layout->carrier;
  if (!carrier) return;
  const auto add = [&](double made_mm, bool hole, const char* grade) {
    if (made_mm > 0.0 && find(made_mm, hole) == nullptr)
      sizes_.push_back({made_mm, made_mm, hole, grade});
  };
  add(carrier->pin_hole_diameter_mm, true, kSeatClass);
  add(carrier->pin_diameter_mm, false, kPinClass);
  add(carrier->seat_diameter_mm, true, kSeatClass);
}

const FittedSize* FittedSizes::find(double diameter_mm, bool hole) const {
  const auto found = std::find_if(sizes_.begin(), sizes_.end(), [&](const FittedSize& size) {
    return size.hole == hole && std::abs(size.made_mm - diameter_mm) < tolerance::kSameSize_mm;
  });
  return found == sizes_.end() ? nullptr : &*found;
}

SizeLimits FittedSizes::limits(const std::string& grade, double size_mm) const {
  if (made_.making == Making::kPrinted) {
    if (std::isnan(made_.thickness_mm))
      return general_limits(made_, size_mm, SizeDirection::kAcross);
    return {.lower_mm = -made_.thickness_mm, .upper_mm = made_.thickness_mm, .stated = true};
  }
  const auto limits = fit_limits(grade, size_mm);
  if (!limits) return general_limits(made_, size_mm, SizeDirection::kAcross);
  return {.lower_mm = limits->lower_mm, .upper_mm = limits->upper_mm, .fit = grade, .stated = true};
}

}  // namespace trueflank::io
