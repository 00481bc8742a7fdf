// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/profile.h"

#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

struct Notice {
  std::string message;
  std::string cure;
};

std::vector<Notice> notices(const ToothProfile& profile) {
  const ProfileNotes& notes = profile.notes();
  const Gear& gear = profile.gear();
  const bool external = gear.kind == GearKind::kExternal;
  const auto diameter = [](double radius_mm) { return mm_text(2.0 * radius_mm); };
  std::vector<Notice> list;
  if (notes.pointed)
    list.push_back({"the teeth are pointed and end at diameter " + diameter(profile.tip_radius_mm()) +
                        " instead of " + diameter(gear.tip_radius_mm),
                    "a smaller profile shift, or a tip diameter of at " +
                        std::string(external ? "most " : "least ") +
                        bound_text(2.0 * profile.tip_radius_mm(), external ? Rounded::kDown : Rounded::kUp) + " mm"});
  if (notes.full_round && !notes.space_closed)  // a space that closes has no root to be rounded
    list.push_back({"the root rounding does not fit and is reduced to the full round, " +
                        number_text(profile.root_radius_coefficient()) + " module",
                    external || gear.ring_root == RingRoot::kFillet
                        ? "rack.root_radius of at most " +
                              bound_text(profile.root_radius_coefficient(), Rounded::kDown)
                        : "cutter.tip_radius of at most " +
                              bound_text(profile.root_radius_coefficient(), Rounded::kDown)});
  if (notes.space_closed)
    list.push_back({"the tooth spaces close at diameter " + diameter(profile.root_radius_mm()) +
                        ", before the root circle of " + diameter(nominal_root_radius_mm(gear)),
                    "a larger profile shift or a smaller dedendum"});
  if (notes.tip_inside_base)
    list.push_back({"the tip circle of diameter " + diameter(profile.tip_radius_mm()) +
                        " lies inside the base circle of " + diameter(base_radius_mm(gear)) +
                        "; the flank goes on radially there",
                    "a tip diameter of at least " + bound_text(2.0 * base_radius_mm(gear), Rounded::kUp) +
                        " mm or a larger profile shift"});
  if (notes.tip_trimmed)
    list.push_back({"the cutter trims the tip corners; the involute ends at diameter " +
                        diameter(profile.tip_form_radius_mm()),
                    "a cutter with fewer teeth, or a tip diameter of at least " +
                        bound_text(2.0 * profile.tip_form_radius_mm(), Rounded::kUp) + " mm"});
  return list;
}

}  // namespace

Findings check_profile(const GearTrain& train) {
  Findings findings;
  for (const TrainGear& gear : train.gears) {
    const std::vector<Notice> list = notices(gear.profile);
    const auto count = static_cast<double>(list.size());
    Finding finding{.id = "profile",
                    .where = gear.name,
                    .status = list.empty() ? CheckStatus::kPass : CheckStatus::kWarn,
                    .value = count,
                    .limit = 0.0,
                    .margin = -count,
                    .message = gear.name + ": "};
    if (list.empty()) finding.message += "the teeth are as asked";
    for (std::size_t i = 0; i < list.size(); ++i) {
      finding.message += (i ? "; " : "") + list[i].message;
      finding.cure += (i ? "; " : "") + list[i].cure;
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace trueflank
