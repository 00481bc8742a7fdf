// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"

// What a test bench delivers, before anything is known about the drive.
namespace trueflank::loop {

/// One row of a bench file. The input is always the sun side; torques are magnitudes.
struct BenchRow {
  bool forward = true;  ///< the input drives
  double speed_rpm = 0.0;  ///< of the input, magnitude
  double input_nm = 0.0, output_nm = 0.0;
  double temperature_c = kNaN;
  double angle_deg = kNaN;  ///< of the input
  double sigma_nm = kNaN;   ///< of the torque on the driven side
  int file = 0;             ///< index into BenchData::files
  int line = 0;             ///< in the file
};

enum class BenchQuantityKind { kForwardEfficiency, kBackwardEfficiency, kReverseStartingTorque };
/// One row of a `quantity,value` file.
struct BenchQuantity {
  BenchQuantityKind kind = BenchQuantityKind::kForwardEfficiency;
  double value = 0.0;       ///< efficiency 0 ... 1, or N m
  double load_nm = kNaN;    ///< torque at the output; NaN: not given
  int file = 0, line = 0;
};

struct BenchData {
  std::vector<std::string> files;
  std::vector<BenchRow> rows;
  std::vector<BenchQuantity> quantities;
  std::vector<std::string> notes;  ///< what was left out and why, one sentence each
};

/// Reads bench files of either kind (docs/drive-loop.md). Rows that cannot be used are left out and told.
/// Errors: all files' together, with file, line, key and remedy: missing columns, columns of another
/// unit, values that carry a unit, a file that is no bench file, nothing usable left.
[[nodiscard]] ResultAll<BenchData> read_bench_files(const std::vector<std::string>& paths);
/// One file's text, added to data.
[[nodiscard]] Errors read_bench_text(const std::string& file, std::string_view text, BenchData& data);

}  // namespace trueflank::loop
