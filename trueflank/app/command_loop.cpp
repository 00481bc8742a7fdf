// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "trueflank/app/commands.h"
#include "trueflank/app/design_input.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/loop/close_loop.h"
#include "trueflank/loop/loop_html.h"

namespace trueflank::app {
namespace {

/// The gear that was measured; the only one where the design has but one.
Result<std::string> measured_gear(const GearTrain& train, const std::string& asked) {
  std::string names;
  for (const TrainGear& gear : train.gears) {
    if (gear.name == asked) return asked;
    names += (names.empty() ? "" : ", ") + gear.name;
  }
  if (asked.empty() && train.gears.size() == 1) return train.gears.front().name;
  return fail({.code = ErrorCode::kUsage,
               .message = asked.empty() ? "which gear was measured?" : "this design has no such gear",
               .key = "--gear",
               .value = asked,
               .remedy = names});
}

}  // namespace

int run_loop(const LoopOptions& options) {
  const auto train = read_train(options.design);
  if (!train) return report_errors(train.error());
  const auto gear = measured_gear(*train, options.gear);
  if (!gear) return report_errors({gear.error()});
  const auto closed =
      loop::close_loop(*train, *gear, options.data, {.aligned = options.aligned});
  if (!closed) return report_errors(closed.error());
  const std::filesystem::path folder(options.folder);
  if (auto ok = io::create_folder(folder); !ok) return report_errors({ok.error()});
  if (auto ok = io::write_file(folder / "loop.html", loop::loop_html(*closed)); !ok)
    return report_errors({ok.error()});
  if (auto ok = io::write_file(folder / "loop.json", loop::loop_json(closed->result)); !ok)
    return report_errors({ok.error()});
  if (!options.quiet)
    if (auto ok = print(loop::loop_text(closed->result)); !ok) return report_errors({ok.error()});
  return 0;
}

}  // namespace trueflank::app
