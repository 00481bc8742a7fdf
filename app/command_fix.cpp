// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/fix_design.h"

namespace trueflank::app {

int run_fix(const FixCommand& options) {
  const auto fixed = [&] {
    const Progress progress("looking for the smallest change", options.quiet);
    return fixed_design(options.design, {.warnings = options.warnings});
  }();
  if (!fixed) return report_errors(fixed.error());
  if (auto ok = write_document(options.output, fixed->design_text); !ok) return report_errors({ok.error()});
  if (!options.quiet && options.output != "-")
    if (auto ok = print(fixed->summary); !ok) return report_errors({ok.error()});
  return fixed->cured ? 0 : 1;
}

}  // namespace trueflank::app
