// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/compare_report.h"

namespace trueflank::app {

int run_compare(const CompareOptions& options) {
  auto report = [&] {
    const Progress progress("comparing", options.quiet);
    return compare_files(options.golden, options.fresh,
                         {.tolerance_um = options.tolerance_um,
                          .locate_always = !options.picture.empty()});
  }();
  if (!report) return report_errors(report.error());
  report->picture = options.picture;
  if (!options.json.empty())
    if (auto ok = write_document(options.json, comparison_json(*report)); !ok)
      return report_errors({ok.error()});
  if (!options.picture.empty() && report->difference)
    if (auto ok = write_document(options.picture, comparison_picture(*report)); !ok)
      return report_errors({ok.error()});
  const bool output_taken = options.json == "-" || options.picture == "-";
  if (!options.quiet && !output_taken)
    if (auto ok = print(comparison_text(*report)); !ok) return report_errors({ok.error()});
  return report->comparison.same ? 0 : 1;
}

}  // namespace trueflank::app
