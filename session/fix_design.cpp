// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/fix_design.h"

#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_edit.h"
#include "trueflank/design/design_file.h"
#include "trueflank/session/gearbox.h"
#include "trueflank/session/reported_cure_of.h"

namespace trueflank {
namespace {

std::string findings_text(const Findings& findings, CheckStatus status) {
  std::string text;
  for (const Finding& f : findings)
    if (f.status == status) text += "  " + f.id + " " + f.where + ": " + f.message + "\n";
  return text;
}

bool fails(const Findings& findings) { return verdict(findings) == CheckStatus::kFail; }

/// What the parts around the gears say: those of a housing.
ResultAll<Findings> machine_findings(const Gearbox& gearbox) {
  const auto& parts = gearbox.parts();
  if (!parts) return fail_all(parts.error());
  return gearbox.train().design.machine ? check_machine(gearbox.train(), *parts) : Findings{};
}

std::string headline(const GearTrain& before, const JointCure& cure, const std::vector<DesignKeyChange>& written_out) {
  const std::string& name = before.design.name;
  if (cure.changed) {
    io::ReportedCure reported = reported_cure_of(before, cure);
    for (const DesignKeyChange& key : written_out) reported.changes.push_back({key.dotted(), key.before, key.after});
    return name +
           (cure.cured() ? ": every check passes with\n"
                         : ": the nearest that was found, which still fails\n") +
           io::cure_table(reported);
  }
  return name + (cure.cured() ? ": no check fails, nothing is changed\n"
                              : ": no change near this design mends it\n");
}

std::string result_text(const GearTrain& before, const JointCure& cure, const std::vector<DesignKeyChange>& written_out) {
  std::string text = headline(before, cure, written_out);
  if (cure.cured()) {
    const std::string warnings = findings_text(cure.findings, CheckStatus::kWarn);
    return text + (warnings.empty() ? "" : "warnings that stay\n" + warnings);
  }
  text += "still fails\n" + findings_text(cure.findings, CheckStatus::kFail);
  if (!cure.conflict.empty()) text += cure.conflict + "\n";
  return text;
}

}  // namespace

ResultAll<FixedDesign> fixed_design(const std::string& path, const FixOptions& options) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  const auto gearbox = Gearbox::read_text(*text, path);
  if (!gearbox) return fail_all(gearbox.error());
  if (const auto& parts = gearbox->parts(); !parts) return fail_all(parts.error());
  const GearTrain& train = gearbox->train();
  Findings findings = check_gearbox(train);
  const auto around = machine_findings(*gearbox);
  if (!around) return fail_all(around.error());
  findings.insert(findings.end(), around->begin(), around->end());
  const JointCure cure =
      fails(findings) || options.warnings
          ? joint_cure(train, findings, {}, findings_around)
          : JointCure{.design = train.design, .findings = findings, .conflict = {}};
  auto fixed = cure.changed ? edited_design(*text, path, cure.design) : ResultAll<EditedDesign>(EditedDesign{*text, {}});
  if (!fixed) return fail_all(fixed.error());
  return FixedDesign{.cured = cure.cured(),
                     .design_text = std::move(fixed->text),
                     .summary = result_text(train, cure, fixed->written_out)};
}

}  // namespace trueflank
