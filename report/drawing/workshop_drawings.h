// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "trueflank/export/reported_file.h"
#include "trueflank/report/drawing/gear_table.h"
#include "trueflank/report/drawing/sheet.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/strength.h"

// Workshop drawings: a sheet a part with views, dimensions and the table of gear data, and a sheet of
// the assembly with the parts list (docs/drawings.md).
namespace trueflank::io {

/// What the drawings show; nothing is owned.
struct DrawingModel {
  const GearTrain* train = nullptr;
  const PartShapes* shapes = nullptr;
  const nlohmann::ordered_json* report = nullptr;  ///< report.json: the source of every number in a table
  const StrengthOptions* materials = nullptr;
};

/// One part on A4 or A3: section through the axis and view of the lower face in first-angle
/// projection, diameters, widths, limits, datums, tolerances, surfaces, table of gear data, holes, notes, title block.
[[nodiscard]] Sheet part_sheet(const DrawingModel& model, const PartShape& part);
/// The set in section and seen from below, with item numbers and the parts list.
[[nodiscard]] Sheet assembly_sheet(const DrawingModel& model);

struct DrawingOptions {
  std::filesystem::path folder;
  std::string part;  ///< this part alone, without the assembly; empty: all
};

/// `PART.pdf` and `PART_drawing.dxf` of every part, `assembly.pdf` and `assembly_drawing.dxf`.
/// Errors: as AtomicFile's. Files written before an error stay; none of them is incomplete.
[[nodiscard]] Result<std::vector<ReportedFile>> write_workshop_drawings(const DrawingModel& model,
                                                                        const DrawingOptions& options);

}  // namespace trueflank::io
