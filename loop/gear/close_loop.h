// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/base/result.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/result/loop_result.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/process.h"

namespace trueflank::loop {

struct LoopOptions {
  bool aligned = false;  ///< scans stand in the gear's own frame
  DeclaredFamilies declared = nullptr;  ///< effects the user adds to the library
  /// How the part is made, where the data do not say it.
  std::optional<Process> process = {};
  Makings makings = kAnyMaking;  ///< ways of making that are open: filled in from process and data
};

/// Everything the charts need beside the result.
struct GearLoop {
  LoopResult result;
  FlankGeometry geometry;
  Observations table;
  std::vector<float> before_um, after_um;  ///< residual of each row of the table
};

/// Fills in the largest errors from the residuals of the table.
void find_largest_errors(GearLoop& done);

/// Closes the loop of one gear: residual, structure, effects, uncertainty, verdict.
/// Where the files are of several parts (MeasuredData), what repeats is told from what does not.
/// Time and memory grow linearly with the points: figures in docs/loop.md.
/// Errors: all files' together, with file and line; data that are not of this gear.
[[nodiscard]] ResultAll<GearLoop> close_loop(const GearTrain& train, const std::string& gear_name,
                                             const std::vector<std::string>& files,
                                             const LoopOptions& options);
/// The same for a profile and data already read.
[[nodiscard]] ResultAll<GearLoop> close_loop(const FlankGeometry& geometry,
                                             const std::string& gear_name,
                                             MeasuredData data, const LoopOptions& options);

}  // namespace trueflank::loop
