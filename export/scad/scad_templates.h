// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/reported_file.h"
#include "trueflank/train/gear_train.h"

namespace trueflank::io {

/// A template of templates/openscad with a design's numbers and profiles in it.
struct FilledTemplate {
  std::string file_name;  ///< "template_housing.scad"
  std::string text;
};

/// The templates that suit a design: housing, carrier, motor adapter and output flange for planets,
/// test jig for gears with bores, fit coupon for every mesh's first. They use the parts' own .scad
/// files, which stand beside them.
[[nodiscard]] std::vector<FilledTemplate> scad_templates(const GearTrain& train);

/// Writes them into a folder; their format in the report is "scad-template", as they are tools
/// beside the parts, not parts. Errors: as AtomicFile's.
[[nodiscard]] Result<std::vector<ReportedFile>> write_scad_templates(
    const std::filesystem::path& folder, const GearTrain& train);

}  // namespace trueflank::io
