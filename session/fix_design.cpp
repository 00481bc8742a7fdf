// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/fix_design.h"

#include "trueflank/design/design_edit.h"
#include "trueflank/design/design_file.h"
#include "trueflank/session/reported_cure_of.h"

namespace trueflank {
namespace {

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
           io::cure_table(reported_cure_of(before, cure));
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
