// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iostream>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/close_loop.h"

namespace trueflank::app {

int run_loop(const LoopOptions& options) {
  const auto gearbox = Gearbox::read(options.design);
  if (!gearbox) return report_errors(gearbox.error());
  const auto closed = [&] {
    const Progress progress("closing the loop", options.quiet);
    return close_loop(
        *gearbox, options.data,
        {.gear = options.gear, .aligned = options.aligned, .effects_file = options.effects});
  }();
  if (!closed) return report_errors(closed.error());
  for (const std::string& row : closed->left_out_rows()) std::cerr << without_control(row) << "\n";
  if (auto ok = write_loop(*closed, options.folder); !ok) return report_errors({ok.error()});
  const std::string page = (std::filesystem::path(options.folder) / "loop.html").string();
  if (!options.quiet)
    if (auto ok = print(closed->text() + open_text(page)); !ok) return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
