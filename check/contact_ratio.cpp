// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/contact_ratio.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

constexpr double kWantedContactRatio = 1.1;

/// Transverse contact of the pair with another tip of gear 1; NaN where that tooth cannot be made, or is pointed before.
double ratio_with_tip(const GearPair& pair, double tip_diameter_mm) {
  Gear gear = pair.gear1();
  gear.tip_radius_mm = 0.5 * tip_diameter_mm;
  const auto made = ToothProfile::make(gear);
  if (!made || made->notes().pointed) return kNaN;
  GearPair changed = pair;
  changed.profile1 = &*made;
  const ContactRatios ratios = contact_ratios(changed);
  return std::min(ratios.total, ratios.effective);
}

Finding contact_ratio_finding(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  const ContactRatios ratios = contact_ratios(pair);
  const double overlap = overlap_ratio(train, mesh);
  const double transverse = std::min(ratios.total, ratios.effective);
  const double value = std::max(transverse, 0.0) + overlap;
  const double limit = value < 1.0 ? 1.0 : kWantedContactRatio;
  Finding finding{.id = "contact_ratio",
                  .where = mesh.name,
                  .value = value,
                  .limit = limit,
                  .margin = value - limit};
  const auto ends_early = [](const ToothProfile& profile) {
    return std::abs(profile.tip_form_radius_mm() - profile.tip_radius_mm()) > tolerance::kTouch_mm;
  };
  const bool form = ends_early(*pair.profile1) || ends_early(*pair.profile2);
  finding.message = "transverse " + number_text(ratios.total, 3) +
                    (form ? " from the tip form circles, " : " from the tip circles, ") +
                    number_text(ratios.effective, 3) + " effective";
  if (overlap > 0.0) finding.message += ", and " + number_text(overlap, 3) + " by the helix";
  const double unrelieved = modified_mesh(train, mesh).unrelieved_contact_ratio;
  const bool relieved = unrelieved < ratios.effective - 1e-9;
  if (relieved)
    finding.message += "; between the starts of the reliefs " + number_text(unrelieved, 3);
  if (value >= kWantedContactRatio) {
    if (!relieved || unrelieved + overlap >= 1.0) return finding;
    finding.status = CheckStatus::kWarn;
    finding.message += ", less than 1 with the helix: without load the teeth change over on their reliefs";
    finding.cure = "reliefs that start nearer to tip and root, by " +
                   mm_text((1.0 - unrelieved - overlap) * line_of_action(pair).base_pitch_mm) +
                   " of roll length in all";
    return finding;
  }
  finding.status = value < 1.0 ? CheckStatus::kFail : CheckStatus::kWarn;
  // both tips lie on the line of action: a length more there is so much more contact
  const double lacking = (limit - value) * line_of_action(pair).base_pitch_mm;
  if (ratios.total - ratios.effective > limit - value) {
    const LineOfAction line = line_of_action(pair);
    const bool at1 = line.effective_start_mm - line.start_mm > line.end_mm - line.effective_end_mm;
    finding.cure = "the root of " + (at1 ? gear1_name(train, mesh) : gear2_name(train, mesh)) +
                   " takes " + number_text(ratios.total - ratios.effective, 3) +
                   " away: a larger profile shift there, or a smaller root rounding";
    return finding;
  }
  const double roll = pair.profile1->tip_form_roll_length_mm() + lacking;
  const double diameter_mm = 2.0 * std::hypot(base_radius_mm(pair.gear1()), roll);
  // a tenth of a micrometre: the last decimal that is written
  if (ratio_with_tip(pair, diameter_mm + 1e-4) + overlap >= limit)
    finding.cure = "a tip diameter of " + gear1_name(train, mesh) + " of " +
                   bound_text(diameter_mm, Rounded::kUp) + " mm gives " + number_text(limit) + ", or ";
  finding.cure += "a smaller working pressure angle (shifts, centre distance)";
  return finding;
}

}  // namespace

Findings check_contact_ratio(const GearTrain& train) {
  return for_each_mesh(train, "contact_ratio", contact_ratio_finding);
}

}  // namespace trueflank
