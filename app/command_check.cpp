// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/evaluate.h"

namespace trueflank::app {

int run_check(const CheckOptions& options) {
  const auto gearbox = Gearbox::read(options.design, {.process = options.process, .kerf_mm = {}});
  if (!gearbox) return report_errors(gearbox.error());
  // What cannot be built is no design that passes, even where only solved shifts show it.
  if (const auto& parts = gearbox->parts(); !parts) return report_errors(parts.error());
  const auto strength =
      strength_options(*gearbox, {.material = options.material, .file = options.materials_file});
  if (!strength) return report_errors(strength.error());
  io::Report report;
  {
    const Progress progress("checking " + gearbox->design().name, options.quiet);
    report = evaluate(*gearbox, *strength);
    if (!options.tolerance.empty())
      if (auto ok = add_tolerance_findings(options.tolerance, report); !ok)
        return report_errors({ok.error()});
  }
  // a document on standard output is alone there: scripts read it
  const bool document_on_output = options.json == "-" || options.html == "-";
  if (!options.json.empty())
    if (auto ok = write_document(options.json, io::report_json(report)); !ok)
      return report_errors({ok.error()});
  if (!options.html.empty())
    if (auto ok = write_document(options.html, report_page(*gearbox, report)); !ok)
      return report_errors({ok.error()});
  if (!options.pictures.empty())
    if (auto ok = write_mesh_pictures(gearbox->train(), options.pictures); !ok)
      return report_errors({ok.error()});
  if (!options.quiet && !document_on_output) {
    std::string text = io::report_text(
        report, {.colour = standard_output_colour(), .every_check = options.verbose});
    if (!options.html.empty()) text += open_text(options.html);
    if (auto ok = print(text); !ok) return report_errors({ok.error()});
  }
  return verdict(report.findings) == CheckStatus::kFail ? 1 : 0;
}

}  // namespace trueflank::app
