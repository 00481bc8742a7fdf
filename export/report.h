// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/inertia.h"
#include "trueflank/train/strength.h"

namespace trueflank::io {

/// Smallest distance and deepest overlap of a mesh's real profiles over a mesh cycle; NaN: not swept.
struct MeshSweep {
  std::string mesh;
  double minimum_clearance_um = kNaN;
  double penetration_um = kNaN;
};

/// A file as it was written and measured again.
struct ReportedFile {
  std::string path;  ///< relative to the output folder
  std::string part;  ///< "assembly" for the assembly
  std::string format;
  std::uint64_t bytes = 0;
  std::uint64_t triangles = 0;    ///< 0 where the format has none
  double accuracy_um = kNaN;      ///< largest distance between file and true surface, both ways
  double volume_mm3 = kNaN;
  double kerf_mm = kNaN;  ///< NaN: the file does not hold the path of a wire
  std::size_t unreached_corners = 0;  ///< corners that the wire is too thick for
  double left_um = kNaN;  ///< deepest material that stays in them
  std::string compensated_for = {};  ///< process whose effects the walls are moved against; or empty
};

/// Inertia of the set, of solids of one density.
struct ReportedInertia {
  double density_kg_m3 = kNaN;
  ReflectedInertia reflected;
};

/// All that a report tells; the same document for check and make.
struct Report {
  const GearTrain* train = nullptr;  ///< not owned
  Findings findings;
  EfficiencyResult efficiency;
  std::optional<StrengthResult> strength;  ///< none for a single gear
  std::optional<ReportedInertia> inertia;
  std::vector<MeshSweep> sweeps;     ///< in the order of the train's meshes; may be empty
  double tolerance_um = kNaN;        ///< NaN for check
  std::vector<ReportedFile> files;   ///< empty for check
};

/// report.json, format "trueflank-report" version 1 (docs/report.md); NaN is null, keys in fixed order.
[[nodiscard]] std::string report_json(const Report& report);

/// The same numbers as a readable table for a terminal of 80 columns.
enum class TextColour { kNone, kAnsi };
[[nodiscard]] std::string report_text(const Report& report, TextColour colour);

}  // namespace trueflank::io
