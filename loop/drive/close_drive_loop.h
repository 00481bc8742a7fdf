// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/loop/drive/bench_table.h"
#include "trueflank/loop/drive/drive_effect.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// Everything the charts and the calibrated design need beside the result.
struct DriveLoop {
  LoopResult result;
  DriveModel model;
  BenchTable table;                ///< empty where only a few numbers were measured
  std::vector<double> before_nm, after_nm;  ///< residual of each point of the table
  std::vector<DriveEffect> effects;         ///< as fitted to all rows, in the order of the coefficients
  std::vector<double> coefficients;
  DriveState state;
};

struct DriveLoopOptions {
  double level = 0.02;  ///< false alarm rate of the first test of structure
};

/// Closes the loop of a drive on its bench: residual, structure, effects, uncertainty, verdict.
/// The engine is the one of the gears (discovery.h).
/// Errors: all files' together, with file and line; units that cannot be.
[[nodiscard]] ResultAll<DriveLoop> close_drive_loop(const GearTrain& train,
                                                    const std::vector<std::string>& files);
/// The same for a drive without a design and data already read.
[[nodiscard]] ResultAll<DriveLoop> close_drive_loop(const DriveModel& model, const BenchData& data,
                                                    const DriveLoopOptions& options = {});

/// The same for a table made elsewhere: logs of other machines, with their own units and hold-out
/// (fold 0). Every point needs its sigma_nm, unit and fold.
[[nodiscard]] DriveLoop close_drive_table(const DriveModel& model, BenchTable table,
                                          const DriveLoopOptions& options = {});

/// A few numbers in place of rows: what each effect alone would have to be, at which load. Names none.
[[nodiscard]] ResultAll<DriveLoop> explain_quantities(const DriveModel& model, const BenchData& data);

}  // namespace trueflank::loop
