// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_fits.h"

#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/machine/fit_class.h"

namespace trueflank {
namespace {

/// How far a bearing's ring may lie below its nominal size, um. Source: ISO 492, class Normal: the
/// mean outer diameter, and the mean bore, up to a size.
struct RingLimit {
  double upto_mm, um;
};
constexpr std::array<RingLimit, 8> kOuter{{{18, 8}, {30, 9}, {50, 11}, {80, 13}, {120, 15},
                                           {150, 18}, {180, 25}, {250, 30}}};
constexpr std::array<RingLimit, 7> kBore{
    {{18, 8}, {30, 10}, {50, 12}, {80, 15}, {120, 20}, {180, 25}, {250, 30}}};

template <std::size_t N>
double below_mm(const std::array<RingLimit, N>& table, double size_mm) {
  for (const RingLimit& row : table)
    if (size_mm <= row.upto_mm) return row.um / 1000.0;
  return kNaN;
}

std::string um(double mm) { return printed("%+.0f", 1000.0 * mm); }

/// "seat 42 H7 (0 to +25 um), clearance 0 to 36 um"
std::string fit_text(const std::string& what, const char* fit, double size_mm,
                     const FitLimits& limits, double ring_mm) {
  const bool hole = fit[0] == 'H';
  const double least = hole ? limits.lower_mm : -ring_mm - limits.upper_mm;
  const double most = hole ? limits.upper_mm + ring_mm : -limits.lower_mm;
  return what + " " + number_text(size_mm) + " " + fit + " (" + um(limits.lower_mm) + " to " +
         um(limits.upper_mm) + " um), clearance " + um(least) + " to " + um(most) + " um";
}

Finding fit_of(const std::string& where, const Bearing& bearing, bool journal, bool held) {
  Finding finding{.id = "fits", .where = where, .unit = "mm"};
  const auto seat = fit_limits(kSeatClass, bearing.outer_mm);
  const auto stem = fit_limits(kJournalClass, bearing.bore_mm);
  if (!seat || !stem) {
    finding.status = CheckStatus::kWarn;
    finding.margin = -1.0;
    finding.message = "no class of ISO 286 is known above " + mm_text(kLargestFit_mm) + ": it is made to size";
    finding.cure = "fit_mm above 0 in [housing]";
    return finding;
  }
  finding.value = seat->upper_mm - seat->lower_mm;
  finding.message = bearing.name + ": " +
                    fit_text("seat", kSeatClass, bearing.outer_mm, *seat,
                             below_mm(kOuter, bearing.outer_mm));
  if (journal)
    finding.message += "; " + fit_text("journal", kJournalClass, bearing.bore_mm, *stem,
                                       below_mm(kBore, bearing.bore_mm));
  if (held) return finding;
  finding.status = CheckStatus::kWarn;
  finding.margin = -1.0;
  finding.message += ": printers do not hold such limits";
  finding.cure = "fit_mm of 0.1 in [housing], or what a test print of the printer says";
  return finding;
}

}  // namespace

Findings check_fits(const GearTrain& train) {
  const auto& machine = train.design.machine;
  if (!machine || machine->housing.fit_mm > 0.0) return {};
  const auto& process = train.design.made.process;
  const bool held = !process || !(process->layer_mm > 0.0);
  Findings all{fit_of("output", machine->bearings.output, true, held)};
  if (machine->bearings.planet) all.push_back(fit_of("planet", *machine->bearings.planet, false, held));
  if (machine->bearings.wheel) all.push_back(fit_of("wheel", *machine->bearings.wheel, true, held));
  return all;
}

}  // namespace trueflank
