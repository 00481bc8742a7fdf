// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/export/reported_file.h"
#include "trueflank/report/reported_cure.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/inertia.h"
#include "trueflank/train/strength.h"
#include "trueflank/train/strength_iso6336.h"
#include "trueflank/train/strength_plastic.h"

namespace trueflank::io {

/// Smallest distance and deepest overlap of a mesh's real profiles over a mesh cycle; NaN: not swept.
struct MeshSweep {
  std::string mesh;
  double minimum_clearance_um = kNaN;
  double penetration_um = kNaN;
};

/// Inertia of the set, of solids of one density.
struct ReportedInertia {
  double density_kg_m3 = kNaN;
  ReflectedInertia reflected;
};

/// All that a report tells; the same document for check and make.
struct Report {
  std::shared_ptr<const GearTrain> train;
  Findings findings;
  std::optional<ReportedCure> cure;  ///< of a design that fails
  EfficiencyResult efficiency;
  std::optional<StrengthResult> strength;  ///< none for a single gear
  std::optional<Iso6336Result> iso6336;    ///< none where a gear that carries is of a plastic
  std::optional<PlasticResult> plastic;    ///< none without a gear of a plastic
  std::optional<ReportedInertia> inertia;
  std::vector<MeshSweep> sweeps;     ///< in the order of the train's meshes; may be empty
  bool inches = false;               ///< the main sizes in inches too
  std::optional<PartShapes> shapes;  ///< whose sizes are told; none where they cannot be made
  BillOfMaterials bill;              ///< of a design with [housing]; empty otherwise
  double tolerance_um = kNaN;        ///< NaN for check
  std::vector<ReportedFile> files;   ///< empty for check
};

/// report.json, format "trueflank-report" version 1 (docs/report.md); NaN is null, keys in fixed order.
[[nodiscard]] std::string report_json(const Report& report);

enum class TextColour { kNone, kAnsi };
struct ReportTextOptions {
  TextColour colour = TextColour::kNone;
  bool every_check = false;  ///< the checks that passed too, each in its line
};
/// The same numbers as a readable table for a terminal of 80 columns. Of the checks, what failed stands
/// first, then what warns, the farthest beyond its limit first; what passed is one line.
[[nodiscard]] std::string report_text(const Report& report, const ReportTextOptions& options = {});

}  // namespace trueflank::io
