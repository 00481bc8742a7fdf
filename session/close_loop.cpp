// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/close_loop.h"

#include <utility>
#include <variant>

#include "trueflank/design/design_file_writer.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/loop/drive/close_drive_loop.h"
#include "trueflank/loop/drive/drive_calibration.h"
#include "trueflank/loop/gear/close_loop.h"
#include "trueflank/loop/measured/text_table.h"
#include "trueflank/report/drive_html.h"
#include "trueflank/report/loop_html.h"
#include "trueflank/session/effects_file.h"

namespace trueflank {

struct ClosedLoop::Data {
  Gearbox gearbox;  // to whose profiles the loop refers
  std::variant<loop::GearLoop, loop::DriveLoop> closed;
  std::string calibrated_design;
};

namespace {

/// Bench files are of the whole drive, all others of one gear: not both in one run.
ResultAll<bool> all_are_bench_files(const std::vector<std::string>& files, const std::string& gear) {
  std::string other;
  std::size_t bench = 0;
  Errors unread;
  for (const std::string& file : files) {
    const auto is_bench = loop::is_bench_file(file);
    if (!is_bench) unread.push_back(is_bench.error());
    else if (*is_bench) ++bench;
    else other = file;
  }
  if (!unread.empty()) return fail_all(std::move(unread));
  if (bench == 0) return false;
  if (bench < files.size())
    return fail_all({{.code = ErrorCode::kUsage,
                      .message = "bench files are of the whole drive, and this file is of a gear",
                      .remedy = "bench files in one run, a gear's files in another",
                      .file = other}});
  if (!gear.empty())
    return fail_all({{.code = ErrorCode::kUsage,
                      .message = "bench files are of the whole drive",
                      .key = "--gear",
                      .value = gear,
                      .remedy = "no --gear with bench files"}});
  return true;
}

}  // namespace

ResultAll<ClosedLoop> close_drive_loop(const Gearbox& gearbox, const std::vector<std::string>& files) {
  auto closed = loop::close_drive_loop(gearbox.train(), files);
  if (!closed) return fail_all(closed.error());
  const loop::CalibratedDesign calibrated = loop::calibrated_design(gearbox.design(), *closed);
  for (const std::string& note : calibrated.notes) closed->result.notes.push_back(note);
  std::string text;
  if (calibrated.design)
    text = design_file_text(*calibrated.design,
                            "Calibrated by trueflank loop with bench data: friction and [losses].");
  return ClosedLoop(std::make_shared<const ClosedLoop::Data>(
      ClosedLoop::Data{gearbox, std::move(*closed), std::move(text)}));
}

const Gearbox& ClosedLoop::gearbox() const { return data_->gearbox; }
const std::string& ClosedLoop::calibrated_design() const { return data_->calibrated_design; }

const loop::LoopResult& ClosedLoop::result() const {
  return std::visit([](const auto& done) -> const loop::LoopResult& { return done.result; }, data_->closed);
}

std::vector<double> ClosedLoop::residuals_before() const {
  if (const auto* gear = std::get_if<loop::GearLoop>(&data_->closed))
    return {gear->before_um.begin(), gear->before_um.end()};
  return std::get<loop::DriveLoop>(data_->closed).before_nm;
}

std::vector<double> ClosedLoop::residuals_after() const {
  if (const auto* gear = std::get_if<loop::GearLoop>(&data_->closed))
    return {gear->after_um.begin(), gear->after_um.end()};
  return std::get<loop::DriveLoop>(data_->closed).after_nm;
}

std::vector<std::string> ClosedLoop::left_out_rows() const {
  std::vector<std::string> rows;
  for (const std::string& note : result().notes)
    if (loop::is_of_left_out_rows(note)) rows.push_back(note);
  return rows;
}

std::string ClosedLoop::json() const { return loop::loop_json(result()); }
std::string ClosedLoop::text() const { return loop::loop_text(result()); }

std::string ClosedLoop::html() const {
  if (const auto* gear = std::get_if<loop::GearLoop>(&data_->closed)) return loop::loop_html(*gear);
  return loop::drive_html(std::get<loop::DriveLoop>(data_->closed));
}

ResultAll<ClosedLoop> close_loop(const Gearbox& gearbox, const std::vector<std::string>& files,
                                 const CloseLoopOptions& options) {
  const auto bench = all_are_bench_files(files, options.gear);
  if (!bench) return fail_all(bench.error());
  return *bench ? close_drive_loop(gearbox, files) : close_gear_loop(gearbox, files, options);
}

ResultAll<ClosedLoop> close_gear_loop(const Gearbox& gearbox, const std::vector<std::string>& files,
                                      const CloseLoopOptions& options) {
  const auto gear = gearbox.gear(options.gear);
  if (!gear) {
    Error error = gear.error();
    error.key = "--gear";
    if (options.gear.empty()) error.message = "which gear was measured?";
    return fail_all({std::move(error)});
  }
  loop::LoopOptions fit{.aligned = options.aligned};
  if (!options.effects_file.empty()) {
    auto declared = read_effects_file(options.effects_file);
    if (!declared) return fail_all(declared.error());
    fit.declared = std::move(*declared);
  }
  auto closed = loop::close_loop(gearbox.train(), (*gear)->name, files, fit);
  if (!closed) return fail_all(closed.error());
  return ClosedLoop(
      std::make_shared<const ClosedLoop::Data>(ClosedLoop::Data{gearbox, std::move(*closed), {}}));
}

Status write_loop(const ClosedLoop& closed, const std::filesystem::path& folder) {
  if (auto ok = io::create_folder(folder); !ok) return ok;
  if (!closed.calibrated_design().empty())
    if (auto ok = io::write_file(folder / "calibrated.toml", closed.calibrated_design()); !ok) return ok;
  if (auto ok = io::write_file(folder / "loop.html", closed.html()); !ok) return ok;
  return io::write_file(folder / "loop.json", closed.json());
}

}  // namespace trueflank
