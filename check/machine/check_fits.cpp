// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_fits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/number_text.h"
#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/machine/machine_layout.h"

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

/// Radial internal clearance of deep groove ball bearings of the usual group, by the bore, um.
/// Source: ISO 5753-1, group N, as bearing makers' catalogues print it.
struct ClearanceLimit {
  double upto_mm, least_um, most_um;
};
constexpr std::array<ClearanceLimit, 9> kClearance{{{10, 2, 13},
                                                    {18, 3, 18},
                                                    {24, 5, 20},
                                                    {30, 5, 20},
                                                    {40, 6, 20},
                                                    {50, 6, 23},
                                                    {65, 8, 28},
                                                    {80, 10, 30},
                                                    {100, 12, 36}}};
/// So much of an interference the raceway moves (bearing makers give 0.7 to 0.9).
constexpr double kRaceway = 0.8;

template <std::size_t N>
double below_mm(const std::array<RingLimit, N>& table, double size_mm) {
  for (const RingLimit& row : table)
    if (size_mm <= row.upto_mm) return row.um / 1000.0;
  return kNaN;
}

std::string um(double mm) { return printed("%+.0f", 1000.0 * mm); }

/// "seat 42 H7 (0 to +25 um), clearance 0 to 36 um"; `other` is what it goes with.
std::string fit_text(const std::string& what, const std::string& fit, double size_mm,
                     const FitLimits& limits, const std::optional<FitLimits>& other) {
  std::string text = what + " " + number_text(size_mm) + " " + fit + " (" + um(limits.lower_mm) +
                     " to " + um(limits.upper_mm) + " um)";
  if (!other || std::isnan(other->lower_mm)) return text;
  const bool is_hole = is_capital(fit[0]);
  const FitLimits &hole = is_hole ? limits : *other, &shaft = is_hole ? *other : limits;
  return text + ", clearance " + um(hole.lower_mm - shaft.upper_mm) + " to " +
         um(hole.upper_mm - shaft.lower_mm) + " um";
}

/// A side of a seat: what is made, and what is known of its mate.
struct Side {
  const char* what;
  std::string fit;  ///< no class: nothing is told
  double size_mm = 0.0;
  std::optional<FitLimits> mate = {};
};

Finding fit_of(const std::string& where, const std::string& name, const std::vector<Side>& sides,
               bool held) {
  Finding finding{.id = "fits", .where = where, .value = 0.0, .unit = "mm"};
  for (const Side& side : sides) {
    const auto limits = fit_limits(side.fit, side.size_mm);
    if (!limits) {
      finding.status = CheckStatus::kWarn;
      finding.value = kNaN;
      finding.margin = -1.0;
      finding.message =
          "no class of ISO 286 is known above " + mm_text(kLargestFit_mm) + ": it is made to size";
      finding.cure = "fit_mm above 0 in [housing]";
      return finding;
    }
    if (finding.message.empty()) finding.value = limits->upper_mm - limits->lower_mm;
    finding.message += (finding.message.empty() ? name + ": " : "; ") +
                       fit_text(side.what, side.fit, side.size_mm, *limits, side.mate);
  }
  if (held) return finding;
  finding.status = CheckStatus::kWarn;
  finding.margin = -1.0;
  finding.message += ": printers do not hold such limits";
  finding.cure = "no fit in [housing] and [bearings], and fit_mm of 0.1 or what a test print of the "
                 "printer says";
  return finding;
}

/// What tight fits leave of a ball bearing's radial clearance, both in the middle of their limits:
/// below nothing its balls are squeezed. `tight_um`: how much smaller than the journal the bore is,
/// and than the outer ring the seat.
void judge_clearance(const Bearing& bearing, double tight_um, Finding& finding) {
  const auto row =
      std::find_if(kClearance.begin(), kClearance.end(),
                   [&](const ClearanceLimit& limit) { return bearing.bore_mm <= limit.upto_mm; });
  if (!(tight_um > 0.0) || row == kClearance.end() || bearing.kind != BearingKind::kBalls) return;
  const double left = 0.5 * (row->least_um + row->most_um) - kRaceway * tight_um;
  finding.message += "; of the bearing's clearance of " + number_text(row->least_um, 0) + " to " +
                     number_text(row->most_um, 0) + " um (ISO 5753-1, group N) they leave " +
                     number_text(left, 1) + " um in the middle";
  if (left >= 0.0) return;
  finding.status = std::max(finding.status, CheckStatus::kWarn);
  finding.value = left / 1000.0;
  finding.limit = 0.0;
  finding.margin = finding.value;
  finding.message += ": its balls are squeezed";
  finding.cure = "a looser class, or a bearing of a group of more clearance (C3)";
}

/// The seats of a design, as far as they have classes.
class FittedSeats {
 public:
  FittedSeats(const GearTrain& train, bool held) : held_(held), layout_(*machine_layout(train)) {
    const MachineDesign& machine = *train.design.machine;
    const SeatFits& fits = layout_.fits;
    bearing("output", machine.bearings.output, fits.output, true);
    if (machine.bearings.planet) bearing("planet", *machine.bearings.planet, fits.planet, false);
    if (machine.bearings.wheel) bearing("wheel", *machine.bearings.wheel, fits.wheel, true);
    hole("motor_shaft", "shaft of the motor", fits.shaft, machine.motor.shaft_diameter_mm);
    hole("motor_pilot", "collar of the motor", fits.pilot, machine.motor.pilot_diameter_mm);
    if (layout_.wheel_gear >= 0) {
      mating("lid", "lid in the housing", fits.rim, 2.0 * layout_.cavity_radius_mm);
    } else {
      mating("ring", "seat in housing and lid", fits.ring, 2.0 * layout_.ring_radius_mm);
      hole("pins", "pins of the planets", fits.pin, layout_.carrier.pin_diameter_mm);
    }
  }
  Findings findings;

 private:
  void add(const std::string& where, const std::string& name, std::vector<Side> sides) {
    std::erase_if(sides, [](const Side& side) { return side.fit.empty(); });
    if (!sides.empty()) findings.push_back(fit_of(where, name, sides, held_));
  }
  void bearing(const char* where, const Bearing& bearing, const SeatFit& fit, bool has_journal) {
    std::vector<Side> sides{{"seat", fit.hole, bearing.outer_mm,
                             FitLimits{-below_mm(kOuter, bearing.outer_mm), 0.0}}};
    if (has_journal)
      sides.push_back({"journal", fit.shaft, bearing.bore_mm,
                       FitLimits{-below_mm(kBore, bearing.bore_mm), 0.0}});
    double tight_um = 0.0;
    for (const Side& side : sides)
      if (const auto made = fit_limits(side.fit, side.size_mm); made && !side.fit.empty()) {
        const bool hole = is_capital(side.fit[0]);
        const double mate = side.mate->lower_mm + side.mate->upper_mm;
        const double over = 0.5 * (made->lower_mm + made->upper_mm - mate) * (hole ? -1.0 : 1.0);
        tight_um += 1000.0 * std::max(0.0, over);
      }
    const std::size_t before = findings.size();
    add(where, bearing.name, std::move(sides));
    // a ring is not moved by a journal of plastic
    if (held_ && findings.size() > before && !std::isnan(findings.back().value))
      judge_clearance(bearing, tight_um, findings.back());
  }
  void hole(const char* where, const char* name, const SeatFit& fit, double size_mm) {
    if (size_mm > 0.0) add(where, name, {{"hole", fit.hole, size_mm}});
  }
  /// Hole and shaft are both made.
  void mating(const char* where, const char* name, const SeatFit& fit, double size_mm) {
    const auto mate = fit.shaft.empty() ? FitLimits{} : fit_limits(fit.shaft, size_mm);
    add(where, name, {{"hole", fit.hole, size_mm, mate}, {where, fit.shaft, size_mm}});
  }

  bool held_;
  MachineLayout layout_;
};

}  // namespace

Findings check_fits(const GearTrain& train) {
  if (!train.design.machine) return {};
  const auto& process = train.design.made.process;
  const bool held = !process || !(process->layer_mm > 0.0);
  return FittedSeats(train, held).findings;
}

}  // namespace trueflank
