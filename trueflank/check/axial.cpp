// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/axial.h"

#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

/// Radii about the train's axis between which a gear's material may stand.
struct Reach {
  double inner_mm = 0.0, outer_mm = 0.0;
};

Reach reach_of(const GearTrain& train, const TrainGear& gear) {
  const double tip = gear.profile.tip_radius_mm(), a = train.centre_distance_mm;
  if (gear.profile.gear().kind == GearKind::kInternal) return {tip, 1e300};  // the rim is unbounded here
  if (gear.name.starts_with("planet")) return {a - tip, a + tip};
  return {0.0, tip};
}

bool same_body(const TrainGear& a, const TrainGear& b) {
  return a.name.starts_with("planet") && b.name.starts_with("planet");
}

}  // namespace

Findings check_axial(const GearTrain& train) {
  Finding finding{.id = "axial", .where = "train", .limit = 0.0, .unit = "mm"};
  for (const TrainGear& lower : train.gears) {
    for (const TrainGear& upper : train.gears) {
      if (lower.layer >= upper.layer || same_body(lower, upper)) continue;
      const Reach a = reach_of(train, lower), b = reach_of(train, upper);
      if (a.outer_mm <= b.inner_mm || b.outer_mm <= a.inner_mm) continue;
      const double gap = upper.z_lower_mm - (lower.z_lower_mm + lower.face_width_mm);
      if (gap >= finding.value) continue;  // NaN: the first one
      finding.value = finding.margin = gap;
      finding.message = lower.name + " and " + upper.name +
                        (gap > 0.0 ? " stand " + mm_text(gap) + " apart"
                                   : " touch: they overlap by " + mm_text(-gap)) +
                        " along the axis";
      finding.status = gap > 0.0 ? CheckStatus::kPass : CheckStatus::kFail;
      finding.cure = gap > 0.0 ? ""
                               : "layer_gap_mm above " +
                                     number_text(train.design.layer_gap_mm - gap) +
                                     ", or a face width of " + lower.name + " below " +
                                     mm_text(lower.face_width_mm + gap);
    }
  }
  if (finding.message.empty()) {
    finding.status = CheckStatus::kNotApplicable;
    finding.message = "all parts are in one layer, or pass each other";
  }
  return {finding};
}

}  // namespace trueflank
