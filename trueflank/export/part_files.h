// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/report.h"
#include "trueflank/solid/part_shape.h"

namespace trueflank::io {

/// Formats by their file extension, in the order they are written.
[[nodiscard]] const std::vector<std::string>& format_names();

struct PartFilesOptions {
  std::vector<std::string> formats;  ///< of format_names()
  double tolerance_mm = 1e-3;
  std::string part;  ///< only this one, no assembly; empty: all and the assembly
};

/// Writes one file a part and format and the assembly where the format can hold one; every mesh file
/// is read back from the disk and measured against the true surfaces.
/// Requires: `shapes` are those of `train`; the folder exists. Errors: the first; files written before
/// it stay whole.
[[nodiscard]] Result<std::vector<ReportedFile>> write_part_files(const GearTrain& train,
                                                                 const PartShapes& shapes,
                                                                 const std::filesystem::path& folder,
                                                                 const PartFilesOptions& options);

}  // namespace trueflank::io
