// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/solid/shape/part_shape.h"

namespace trueflank::io {

/// "parts" of report.json: sizes, limits, holes, tolerances and surfaces of every made part, the
/// numbers of its drawing and of its STEP file by AP242 (docs/drawings.md). An object, one member a
/// part.
[[nodiscard]] std::string part_sizes_json_text(const GearTrain& train, const PartShapes& shapes);

}  // namespace trueflank::io
