// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "trueflank/app/commands.h"
#include "trueflank/app/design_input.h"
#include "trueflank/app/effects_file.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/loop/close_drive_loop.h"
#include "trueflank/loop/close_loop.h"
#include "trueflank/loop/drive_calibration.h"
#include "trueflank/loop/drive_html.h"
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

int write_results(const LoopOptions& options, const std::string& html,
                  const loop::LoopResult& result) {
  const std::filesystem::path folder(options.folder);
  if (auto ok = io::create_folder(folder); !ok) return report_errors({ok.error()});
  if (auto ok = io::write_file(folder / "loop.html", html); !ok) return report_errors({ok.error()});
  if (auto ok = io::write_file(folder / "loop.json", loop::loop_json(result)); !ok)
    return report_errors({ok.error()});
  if (!options.quiet)
    if (auto ok = print(loop::loop_text(result)); !ok) return report_errors({ok.error()});
  return 0;
}

/// Bench files are of the whole drive, all others of one gear: not both in one run.
Result<bool> all_are_bench_files(const LoopOptions& options) {
  std::string other;
  std::size_t bench = 0;
  for (const std::string& file : options.data) {
    if (loop::is_bench_file(file)) ++bench;
    else other = file;
  }
  if (bench == 0) return false;
  if (bench < options.data.size())
    return fail({.code = ErrorCode::kUsage,
                 .message = "bench files are of the whole drive, and this file is of a gear",
                 .remedy = "bench files in one run, a gear's files in another",
                 .file = other});
  if (!options.gear.empty())
    return fail({.code = ErrorCode::kUsage,
                 .message = "bench files are of the whole drive",
                 .key = "--gear",
                 .value = options.gear,
                 .remedy = "no --gear with bench files"});
  return true;
}

int run_drive_loop(const GearTrain& train, const LoopOptions& options) {
  auto closed = loop::close_drive_loop(train, options.data);
  if (!closed) return report_errors(closed.error());
  const loop::CalibratedDesign calibrated = loop::calibrated_design(train.design, *closed);
  for (const std::string& note : calibrated.notes) closed->result.notes.push_back(note);
  if (calibrated.design) {
    const std::filesystem::path folder(options.folder);
    if (auto ok = io::create_folder(folder); !ok) return report_errors({ok.error()});
    const std::string text = design_file_text(
        *calibrated.design, "Calibrated by trueflank loop with bench data: friction and [losses].");
    if (auto ok = io::write_file(folder / "calibrated.toml", text); !ok) return report_errors({ok.error()});
  }
  return write_results(options, loop::drive_html(*closed), closed->result);
}

}  // namespace

int run_loop(const LoopOptions& options) {
  const auto train = read_train(options.design);
  if (!train) return report_errors(train.error());
  const auto bench = all_are_bench_files(options);
  if (!bench) return report_errors({bench.error()});
  if (*bench) return run_drive_loop(*train, options);
  const auto gear = measured_gear(*train, options.gear);
  if (!gear) return report_errors({gear.error()});
  loop::DeclaredFamilies declared;
  if (!options.effects.empty()) {
    const auto read = read_effects_file(options.effects);
    if (!read) return report_errors(read.error());
    declared = *read;
  }
  const auto closed = loop::close_loop(*train, *gear, options.data,
                                       {.aligned = options.aligned, .declared = declared});
  if (!closed) return report_errors(closed.error());
  return write_results(options, loop::loop_html(*closed), closed->result);
}

}  // namespace trueflank::app
