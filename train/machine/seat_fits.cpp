// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/seat_fits.h"

#include <algorithm>

namespace trueflank {
namespace {

double middle_mm(const std::string& fit, double size_mm) {
  const auto limits = fit_limits(fit, size_mm);
  return size_mm + (limits ? limits->middle_mm() : 0.0);
}

/// A seat's own classes, else those of every seat, else the usual ones of a housing without
/// clearance.
SeatFit settled(const HousingDesign& housing, const std::optional<FitClasses>& own,
                const std::string& usual_shaft) {
  SeatFit fit{.hole = {}, .shaft = {}, .clearance_mm = housing.fit_mm};
  for (const auto& named : {own, housing.fit}) {
    if (!named) continue;
    if (fit.hole.empty()) fit.hole = named->hole;
    if (fit.shaft.empty()) fit.shaft = named->shaft;
  }
  if (housing.fit_mm > 0.0) return fit;
  if (fit.hole.empty()) fit.hole = kSeatClass;
  if (fit.shaft.empty()) fit.shaft = usual_shaft;
  return fit;
}

}  // namespace

double SeatFit::hole_mm(double size_mm) const {
  return hole.empty() ? size_mm + clearance_mm : middle_mm(hole, size_mm);
}

double SeatFit::shaft_mm(double size_mm) const {
  return shaft.empty() ? size_mm - clearance_mm : middle_mm(shaft, size_mm);
}

SeatFits seat_fits(const MachineDesign& machine) {
  const HousingDesign& housing = machine.housing;
  const BearingsDesign& bearings = machine.bearings;
  SeatFits fits{.output = settled(housing, bearings.output_fit, kJournalClass),
                .planet = settled(housing, bearings.planet_fit, kJournalClass),
                .wheel = settled(housing, bearings.wheel_fit, kJournalClass),
                .shaft = settled(housing, housing.shaft_fit, ""),
                .pilot = settled(housing, housing.pilot_fit, ""),
                .ring = settled(housing, housing.ring_fit, ""),
                .rim = settled(housing, housing.ring_fit, kJournalClass),
                .pin = {}};
  if (housing.pin_fit) fits.pin.hole = housing.pin_fit->hole;
  return fits;
}

double press_mm(const MachineDesign& machine, double ring_mm) {
  const SeatFits fits = seat_fits(machine);
  double most = 0.0;
  const auto take = [&](double shaft_mm, double hole_mm) {
    most = std::max(most, 0.5 * (shaft_mm - hole_mm));
  };
  const auto seat = [&](const SeatFit& fit, const Bearing& b) {
    take(b.outer_mm, fit.hole_mm(b.outer_mm));
  };
  const auto journal = [&](const SeatFit& fit, const Bearing& b) {
    take(fit.shaft_mm(b.bore_mm), b.bore_mm);
  };
  const BearingsDesign& bearings = machine.bearings;
  seat(fits.output, bearings.output);
  journal(fits.output, bearings.output);
  if (bearings.planet) seat(fits.planet, *bearings.planet);
  if (bearings.wheel) {
    seat(fits.wheel, *bearings.wheel);
    journal(fits.wheel, *bearings.wheel);
  }
  take(machine.motor.pilot_diameter_mm, fits.pilot.hole_mm(machine.motor.pilot_diameter_mm));
  take(fits.ring.shaft.empty() ? ring_mm : fits.ring.shaft_mm(ring_mm), fits.ring.hole_mm(ring_mm));
  if (bearings.planet && !fits.pin.hole.empty())
    take(bearings.planet->bore_mm, fits.pin.hole_mm(bearings.planet->bore_mm));
  return most;
}

}  // namespace trueflank
