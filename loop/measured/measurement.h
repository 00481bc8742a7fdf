// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/gear.h"

// Measured data as files hold them, before anything is known about the gear.
namespace trueflank::loop {

/// No scanner reaches as far; beyond it whole turns of a helical tooth cannot be counted.
constexpr double kFarthest_mm = 1e6;
/// False where a coordinate is no number or lies farther off than any measurement.
[[nodiscard]] inline bool is_measured_point(const std::array<double, 3>& p) {
  return std::abs(p[0]) <= kFarthest_mm && std::abs(p[1]) <= kFarthest_mm && std::abs(p[2]) <= kFarthest_mm;
}

/// Points of a scan [mm]; sigma_um is empty or one value a point.
struct ScanData {
  std::string file;
  std::string part;  ///< name of the part it is of; empty: the only one
  std::vector<std::array<double, 3>> points_mm;
  std::vector<double> sigma_um;
  /// Outward normals of a mesh's points, empty for a cloud: they tell walls from end faces.
  std::vector<std::array<float, 3>> normals;
};

enum class RecordKind { kProfile, kHelix, kIndex, kRadial };

/// One row of an inspection file.
struct InspectionRow {
  RecordKind record = RecordKind::kProfile;
  int tooth = 1;
  Flank flank = Flank::kLeft;
  double diameter_mm = kNaN;
  /// Profiles of machines: `fraction` of the roll length from diameter_mm to this one; NaN: unused.
  double diameter_to_mm = kNaN;
  double fraction = 0.0;
  double z_mm = kNaN;
  double deviation_um = 0.0;
  double sigma_um = kNaN;
  /// Index rows of machines: an arc in the transverse section, + = counter-clockwise, in place of the
  /// deviation along the normal.
  bool along_circle = false;
  int line = 0;  ///< in the file
};
struct InspectionData {
  std::string file;
  std::string part;
  std::vector<InspectionRow> rows;
  std::map<std::string, std::string> keys;  ///< comment lines `# key = value`
  bool common_zero = false;
  bool from_design = false;  ///< `# reference = design`: modifications of the design taken off already
  double ball_diameter_mm = kNaN;
};

enum class SizeQuantity { kSpan, kOverPins, kTipDiameter, kRootDiameter, kBore };
struct SizeRow {
  SizeQuantity quantity = SizeQuantity::kSpan;
  double value_mm = 0.0;
  double detail = kNaN;  ///< teeth spanned, or pin diameter
  double sigma_um = kNaN;
  int line = 0;  ///< in the file
};
struct SizeData {
  std::string file;
  std::string part;
  std::vector<SizeRow> rows;
};

/// Measured data of one part or several, with what was left out and why (one sentence each).
struct MeasuredData {
  std::vector<ScanData> scans;
  std::vector<InspectionData> inspections;
  std::vector<SizeData> sizes;
  std::vector<std::string> notes;
  /// Processes named in the files (`# process = grinding`), each once.
  std::vector<std::string> processes = {};
  [[nodiscard]] bool empty() const { return scans.empty() && inspections.empty() && sizes.empty(); }
};

/// Reads measured files of any kind the loop knows (docs/loop.md), told from their name and header.
/// `PART=FILE` says which part a file is of; a comment line `# part = NAME` in the file says it, too, and
/// `# process = NAME` how the part was made.
/// A file of which a part is unusable is used for the rest, and notes say so.
/// Errors: all files' together; kSyntax with file and line where nothing usable is left.
[[nodiscard]] ResultAll<MeasuredData> read_measured_files(const std::vector<std::string>& paths);

/// Whether a CSV file's header is a bench record's. Errors: the file cannot be read; kUnsupported for pipes and devices,
/// whose data would be gone.
[[nodiscard]] Result<bool> is_bench_file(const std::string& argument);

}  // namespace trueflank::loop
