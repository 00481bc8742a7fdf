// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/base/result.h"
#include "trueflank/report/report.h"
#include "trueflank/session/gearbox.h"

namespace trueflank {

/// What is said of materials beside the design.
struct MaterialOptions {
  std::string material;  ///< of every gear, over what the design says; empty: as the design says
  std::string file;      ///< with more materials than the built-in table's; empty: none
};
/// Materials of a design's gears. Errors: of the file; no such material (the design's with its key).
[[nodiscard]] ResultAll<StrengthOptions> strength_options(const Gearbox& gearbox,
                                                          const MaterialOptions& options = {});

/// Every check, sweep and efficiency of a gearbox. The report shares the gearbox's train.
[[nodiscard]] io::Report evaluate(const Gearbox& gearbox, const StrengthOptions& strength = {});

/// Adds the findings of what tolerances leave. `tolerance`: see parse_tolerance(). Errors: its own.
[[nodiscard]] Status add_tolerance_findings(const std::string& tolerance, io::Report& report);

/// Draws each mesh at its worst place: an SVG of the mesh's name in this folder.
[[nodiscard]] Status write_mesh_pictures(const GearTrain& train, const std::string& folder);

/// The report as one offline page. The gearbox is drawn by its bare teeth where its parts cannot be built.
[[nodiscard]] std::string report_page(const Gearbox& gearbox, const io::Report& report);

}  // namespace trueflank
