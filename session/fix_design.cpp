// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/fix_design.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/joint_cure.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/design/design_edit.h"
#include "trueflank/design/design_file.h"
#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Keys with their values before and after, one a line.
std::string changes_text(const GearboxDesign& before, const GearboxDesign& after) {
  std::string text = "  " + padded("key", 30) + padded("was", 14) + "is\n";
  for (const DesignKeyChange& change : design_changes(before, after))
    text += "  " + padded(change.dotted(), 30) + padded(change.before.empty() ? "-" : change.before, 14) +
            (change.after.empty() ? "-" : change.after) + "\n";
  return text;
}

std::string percent_text(double share) { return std::isnan(share) ? "none" : number_text(100.0 * share, 2) + " %"; }

/// Contact ratio of every mesh and efficiency, before and after.
std::string costs_text(const GearTrain& before, const GearTrain& after) {
  std::string text;
  for (std::size_t k = 0; k < before.meshes.size(); ++k)
    text += "  contact ratio " + before.meshes[k].name + " " +
            number_text(contact_ratios(before.pair(before.meshes[k])).effective, 3) + " -> " +
            number_text(contact_ratios(after.pair(after.meshes[k])).effective, 3) + "\n";
  const EfficiencyResult was = efficiency(before), is = efficiency(after);
  text += "  efficiency forward " + percent_text(was.forward) + " -> " + percent_text(is.forward) + ", backward " +
          percent_text(was.backward) + " -> " + percent_text(is.backward) + "\n";
  return text;
}

std::string findings_text(const Findings& findings, CheckStatus status) {
  std::string text;
  for (const Finding& f : findings)
    if (f.status == status) text += "  " + f.id + " " + f.where + ": " + f.message + "\n";
  return text;
}

std::string result_text(const GearTrain& before, const JointCure& cure) {
  std::string text;
  if (!cure.changed) {
    text = cure.cured() ? before.design.name + ": no check fails, and no smaller trouble that a change near it mends\n"
                        : before.design.name + ": no change near this design mends it\n";
  } else {
    text = before.design.name + (cure.cured() ? ": every check passes with\n" : ": the nearest that was found, which still fails\n") +
           changes_text(before.design, cure.design);
    if (const auto after = lay_out(cure.design)) text += "what it costs\n" + costs_text(before, *after);
  }
  if (!cure.cured()) {
    text += "still fails\n" + findings_text(cure.findings, CheckStatus::kFail);
    if (!cure.conflict.empty()) text += cure.conflict + "\n";
  } else if (const std::string warnings = findings_text(cure.findings, CheckStatus::kWarn); !warnings.empty()) {
    text += "warnings that stay\n" + warnings;
  }
  return text;
}

}  // namespace

ResultAll<FixedDesign> fixed_design(const std::string& path) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  const auto file = read_design_file_text(*text, path);
  if (!file) return fail_all(file.error());
  const auto train = lay_out(file->design);
  if (!train) return fail_all(located(train.error(), *file));
  const JointCure cure = joint_cure(*train);
  auto fixed = edited_design_text(*text, path, cure.design);
  if (!fixed) return fail_all(fixed.error());
  return FixedDesign{.cured = cure.cured(), .design_text = std::move(*fixed), .summary = result_text(*train, cure)};
}

}  // namespace trueflank
