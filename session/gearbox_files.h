// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/export/reported_file.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

struct PlateOptions {
  std::filesystem::path folder;
  std::string bed;  ///< [made] bed
  double tolerance_mm = 1e-3;
  const Process* compensate_for = nullptr;  ///< nullptr: the parts as designed
};

/// Writes `plate_1.3mf` ... : every part that is made, as often as it is needed, the right way up,
/// on beds. Errors: those of print_plates and of the files.
[[nodiscard]] ResultAll<std::vector<io::ReportedFile>> write_plates(const std::string& design_name,
                                                                    const PartShapes& shapes,
                                                                    const PlateOptions& options);

/// Writes `bom.csv`.
[[nodiscard]] Result<io::ReportedFile> write_bill(const BillOfMaterials& bill,
                                                  const std::filesystem::path& folder);

/// `build.html`: how the gearbox is put together, step by step with pictures. Nothing where no
/// order of assembly exists: the check tells.
[[nodiscard]] Result<std::optional<io::ReportedFile>> write_build_guide(
    const GearTrain& train, const PartShapes& shapes, const BillOfMaterials& bill,
    const std::filesystem::path& folder);

}  // namespace trueflank
