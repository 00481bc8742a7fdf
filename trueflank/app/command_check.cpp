// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/commands.h"
#include "trueflank/app/design_input.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/html_document.h"
#include "trueflank/app/terminal.h"
#include "trueflank/check/finding.h"
#include "trueflank/check/tolerance_analysis.h"

namespace trueflank::app {
namespace {

Status add_tolerance(const GearTrain& train, const std::string& text, io::Report& report) {
  const auto options = parse_tolerance(text);
  if (!options) return fail(options.error());
  const auto result = analyse_tolerances(train, *options);
  if (!result) return fail(result.error());
  for (Finding& finding : check_tolerance(train, *result))
    report.findings.push_back(std::move(finding));
  return {};
}

}  // namespace

int run_check(const CheckOptions& options) {
  const auto train = read_train(options.design);
  if (!train) return report_errors(train.error());
  const auto strength = strength_options(options.material, options.materials_file);
  if (!strength) return report_errors(strength.error());
  io::Report report = evaluate(*train, *strength);
  if (!options.tolerance.empty())
    if (auto ok = add_tolerance(*train, options.tolerance, report); !ok)
      return report_errors({ok.error()});
  // a document on standard output is alone there: scripts read it
  const bool document_on_output = options.json == "-" || options.html == "-";
  if (!options.json.empty())
    if (auto ok = write_document(options.json, io::report_json(report)); !ok)
      return report_errors({ok.error()});
  if (!options.html.empty()) {
    const auto shapes = part_shapes(*train);
    const std::string page = html_document(report, shapes ? &*shapes : nullptr);
    if (auto ok = write_document(options.html, page); !ok) return report_errors({ok.error()});
  }
  if (!options.quiet && !document_on_output)
    if (auto ok = print(io::report_text(report, standard_output_colour())); !ok)
      return report_errors({ok.error()});
  return verdict(report.findings) == CheckStatus::kFail ? 1 : 0;
}

}  // namespace trueflank::app
