// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/tip_thickness.h"

#include <algorithm>

#include "trueflank/check/quantity_text.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/train/flank_modifications.h"

namespace trueflank {
namespace {

constexpr double kSmallestTipThickness = 0.2;  // of the module

/// Tip circle at which the involute flanks leave the wanted thickness; NaN where there is none.
double tip_radius_for_thickness_mm(const ToothProfile& profile, double thickness_mm) {
  const double low = profile.gear().kind == GearKind::kExternal ? profile.root_form_radius_mm()
                                                                : profile.tip_form_radius_mm();
  const double high = profile.gear().kind == GearKind::kExternal ? profile.tip_form_radius_mm()
                                                                 : profile.root_form_radius_mm();
  const auto lacking = [&](double r) { return tooth_thickness_mm(profile.gear(), r) - thickness_mm; };
  if (lacking(low) * lacking(high) > 0.0) return kNaN;
  return find_root(lacking, low, high);
}

Finding tip_thickness_finding(const TrainGear& gear) {
  const double m = gear.profile.gear().normal_module_mm;
  const double thickness = least_tip_thickness_mm(gear);
  const double limit = kSmallestTipThickness * m;
  Finding finding{.id = "tip_thickness",
                  .where = gear.name,
                  .value = thickness,
                  .limit = limit,
                  .margin = thickness - limit,
                  .unit = "mm"};
  finding.message = gear.name + ": " + mm_text(thickness) + " thick at tip diameter " +
                    mm_text(2.0 * gear.profile.tip_radius_mm());
  if (!gear.deviation.empty()) finding.message += ", where the modifications leave least";
  if (gear.profile.notes().pointed)
    finding.message = gear.name + ": the teeth are pointed at diameter " +
                      mm_text(2.0 * gear.profile.tip_radius_mm()) + ", before the tip circle of " +
                      mm_text(2.0 * gear.profile.gear().tip_radius_mm);
  if (finding.margin >= 0.0) return finding;
  finding.status = CheckStatus::kWarn;
  const double radius = tip_radius_for_thickness_mm(gear.profile, limit);
  const bool external = gear.profile.gear().kind == GearKind::kExternal;
  if (radius == radius)
    finding.cure = "a tip diameter of " + bound_text(2.0 * radius, external ? Rounded::kDown : Rounded::kUp) + " mm leaves " + mm_text(limit) +
                   (external ? "; or a smaller profile shift" : "; or a smaller shift of the ring");
  else
    finding.cure = "a smaller profile shift";
  return finding;
}

}  // namespace

double least_tip_thickness_mm(const TrainGear& gear) {
  double least = gear.profile.tip_thickness_mm();
  if (gear.deviation.empty()) return least;
  Toothing toothing = gear.toothing();
  toothing.edge_chamfer_mm = 0.0;
  constexpr int kHeights = 16;
  for (int i = 0; i <= kHeights; ++i) {
    const double z = gear.face_width_mm * i / kHeights;
    least = std::min(least, 2.0 * gear.profile.tip_radius_mm() * tip_land_half_angle_rad(toothing, z));
  }
  return least;
}

Findings check_tip_thickness(const GearTrain& train) {
  Findings findings;
  for (const TrainGear& gear : train.gears) findings.push_back(tip_thickness_finding(gear));
  return findings;
}

}  // namespace trueflank
