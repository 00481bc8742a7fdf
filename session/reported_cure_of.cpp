// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/reported_cure_of.h"

#include <algorithm>
#include <memory>

#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_edit.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

/// The advice of a single check that holds beside the joint change: the changed design gets the same.
bool stands_after(const Finding& finding, const Findings& after) {
  return std::any_of(after.begin(), after.end(), [&](const Finding& f) {
    return f.id == finding.id && f.where == finding.where && f.status == finding.status && f.cure == finding.cure;
  });
}

}  // namespace

io::ReportedCure reported_cure_of(const GearTrain& before, const JointCure& cure) {
  io::ReportedCure reported{.cured = cure.cured(), .search_ended = cure.search_ended, .contradiction = cure.conflict};
  for (const Finding& f : cure.findings)
    if (f.status == CheckStatus::kFail) reported.still_failing.push_back(f);
  const auto after = cure.changed ? lay_out(cure.design) : ResultAll<GearTrain>(before);
  if (!cure.changed || !after) return reported;
  for (const DesignKeyChange& change : design_changes(before.design, cure.design))
    reported.changes.push_back({change.dotted(), change.before, change.after});
  for (std::size_t k = 0; k < before.meshes.size(); ++k)
    reported.meshes.push_back({before.meshes[k].name,
                               {contact_ratios(before.pair(before.meshes[k])).effective,
                                contact_ratios(after->pair(after->meshes[k])).effective}});
  const EfficiencyResult was = efficiency(before), is = efficiency(*after);
  reported.forward = {was.forward, is.forward};
  reported.backward = {was.backward, is.backward};
  return reported;
}

std::optional<Findings> findings_around(const GearTrain& gears) {
  const auto train = std::make_shared<const GearTrain>(gears);  // shapes refer to it
  const auto shapes = part_shapes(train);
  if (!shapes) return std::nullopt;
  return train->design.machine ? check_machine(*train, *shapes) : Findings{};
}

io::ReportedCure take_joint_cure(const GearTrain& train, Findings& findings) {
  const bool modified = std::any_of(train.meshes.begin(), train.meshes.end(), [&](const auto& mesh) {
    return is_modified(train, mesh);
  });
  const JointCure cure = joint_cure(train, findings, modified ? kCheckSearchOfModified : kCheckSearch, findings_around);
  io::ReportedCure reported = reported_cure_of(train, cure);
  for (Finding& f : findings)
    if (!stands_after(f, cure.findings)) f.cure.clear();
  return reported;
}

}  // namespace trueflank
