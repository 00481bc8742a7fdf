// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/solid/gear_mesh.h"

namespace trueflank::app {

/// Meshes of all parts, the measured gear's toothing corrected by a loop.json.
struct CorrectedParts {
  std::vector<PartMesh> meshes;
  std::string text;  ///< what was corrected, what was left and why: lines for a person
};

/// Errors: of the file, and where its gear is not of this design.
[[nodiscard]] ResultAll<CorrectedParts> corrected_parts(const GearTrain& train,
                                                        const PartShapes& shapes,
                                                        const std::string& loop_json_file,
                                                        double tolerance_mm);

/// The formats that can carry a correction: meshes. What was asked for beside them is told in `text`.
[[nodiscard]] std::vector<io::FileFormat> formats_of_corrected(
    const std::vector<io::FileFormat>& formats, std::string& text);

}  // namespace trueflank::app
