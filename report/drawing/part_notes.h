// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/drawing/workshop_drawings.h"

namespace trueflank::io {

/// The numbered sentences at the foot of a part's sheet.
[[nodiscard]] std::vector<std::string> part_notes(const DrawingModel& model, const PartShape& part,
                                                  const PartDimensions& dimensions,
                                                  const Workmanship& made);

}  // namespace trueflank::io
