// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "trueflank/loop/result/loop_result.h"
#include "trueflank/session/gearbox.h"

namespace trueflank {

struct CloseLoopOptions {
  std::string gear;          ///< that was measured; empty: the design's only one, or bench files
  bool aligned = false;      ///< scans stand in the gear's own frame
  std::string effects_file;  ///< effects of your own beside the library's (docs/loop.md); empty: none
};

/// A loop that was closed, of a gear or of a whole drive. Never changes; a copy shares everything, the
/// gearbox too.
class ClosedLoop {
 public:
  [[nodiscard]] const Gearbox& gearbox() const;
  [[nodiscard]] const loop::LoopResult& result() const;
  /// Residual of every observation, in the order of the data's rows, against the model as designed and
  /// after the effects found: [um] of a gear, [N m] of a drive.
  [[nodiscard]] std::vector<double> residuals_before() const;
  [[nodiscard]] std::vector<double> residuals_after() const;
  /// Rows of the data that were left out, each with file, line and why: of the result's notes.
  [[nodiscard]] std::vector<std::string> left_out_rows() const;
  [[nodiscard]] std::string json() const;  ///< loop.json
  [[nodiscard]] std::string html() const;  ///< loop.html
  [[nodiscard]] std::string text() const;  ///< what a person reads first
  /// Of bench data: the design with what they showed, as a design file; empty where it can carry none.
  [[nodiscard]] const std::string& calibrated_design() const;

  struct Data;  ///< the measured data and their fit
  explicit ClosedLoop(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

 private:
  std::shared_ptr<const Data> data_;
};

/// Closes the loop of a gear with measured files ("PART=FILE" where they are of several parts), or of
/// the whole drive with bench files.
/// Errors: kUsage where it is not clear which gear was measured, or both kinds of files are given; all
/// files' together, with file and line; those of the effects file.
[[nodiscard]] ResultAll<ClosedLoop> close_loop(const Gearbox& gearbox,
                                               const std::vector<std::string>& files,
                                               const CloseLoopOptions& options = {});
/// The same where the kind of the files is known.
[[nodiscard]] ResultAll<ClosedLoop> close_gear_loop(const Gearbox& gearbox,
                                                    const std::vector<std::string>& files,
                                                    const CloseLoopOptions& options = {});
[[nodiscard]] ResultAll<ClosedLoop> close_drive_loop(const Gearbox& gearbox,
                                                     const std::vector<std::string>& files);

/// Writes loop.html, loop.json and, where there is one, calibrated.toml into a folder, which is made.
[[nodiscard]] Status write_loop(const ClosedLoop& closed, const std::filesystem::path& folder);

}  // namespace trueflank
