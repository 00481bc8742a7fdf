// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/undercut.h"

#include <cmath>

#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Smallest profile shift at which the rack's straight flank still ends on the involute.
double smallest_shift_without_undercut(const ToothProfile& profile) {
  const Gear& gear = profile.gear();
  const double sin_t = std::sin(transverse_pressure_angle_rad(gear));
  const double straight_depth =
      gear.rack.dedendum -
      profile.root_radius_coefficient() * (1.0 - std::sin(gear.rack.pressure_angle_rad));
  return straight_depth - reference_radius_mm(gear) / gear.normal_module_mm * sin_t * sin_t;
}

Finding undercut_finding(const TrainGear& gear) {
  const double limit = smallest_shift_without_undercut(gear.profile);
  Finding finding{.id = "undercut",
                  .where = gear.name,
                  .value = gear.shift,
                  .limit = limit,
                  .margin = gear.shift - limit};
  if (!gear.profile.notes().undercut) {
    finding.message = gear.name + ": profile shift " + number_text(gear.shift) +
                      ", no undercut down to " + number_text(limit);
    if (const double depth = gear.profile.notes().protuberance_undercut_mm; depth > 0.0)
      finding.message += "; the tool's protuberance relieves the root by " + um_text(depth) +
                         " below diameter " + mm_text(2.0 * gear.profile.root_form_radius_mm());
    return finding;
  }
  const double lost = gear.profile.root_form_radius_mm() - base_radius_mm(gear.profile.gear());
  finding.status = CheckStatus::kWarn;
  finding.message = gear.name + ": the tool cuts into the involute; it starts at diameter " +
                    mm_text(2.0 * gear.profile.root_form_radius_mm()) + ", " + mm_text(lost) +
                    " above the base circle (radius)";
  finding.cure = "a profile shift of at least " + bound_text(limit, Rounded::kUp) + " (" +
                 number_text(limit - gear.shift) + " more)";
  return finding;
}

}  // namespace

Findings check_undercut(const GearTrain& train) {
  Findings findings;
  for (const TrainGear& gear : train.gears)
    if (gear.profile.gear().kind == GearKind::kExternal) findings.push_back(undercut_finding(gear));
  if (findings.empty())
    findings.push_back({.id = "undercut",
                        .where = "train",
                        .status = CheckStatus::kNotApplicable,
                        .message = "there is no external gear"});
  return findings;
}

}  // namespace trueflank
