// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/solid/shape/process_compensation.h"

namespace trueflank {

/// As io::export_parts; with `compensate` the meshes are of parts with walls moved against what the
/// design's process does to them, all other formats of the parts as designed. `told` gets lines for
/// a person. Errors: also those of compensated().
[[nodiscard]] ResultAll<std::vector<io::ReportedFile>> exported_files(const io::ExportModel& model,
                                                                      io::ExportOptions options,
                                                                      bool compensate,
                                                                      std::string& told);

/// A failed check `accuracy` for every part whose files miss the tolerance; none where all keep it.
[[nodiscard]] Findings accuracy_findings(const std::vector<io::ReportedFile>& files,
                                         double tolerance_um);

/// compensated(), and a line for a person.
[[nodiscard]] Result<CompensatedShapes> compensated_walls(const PartShapes& shapes,
                                                          const Process& process,
                                                          std::string& told);

}  // namespace trueflank
