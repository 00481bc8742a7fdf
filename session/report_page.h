// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/report/report.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// What the page draws, as JSON; does not look at the report's files.
/// shapes: null where the parts cannot be built; the bare teeth are drawn then.
[[nodiscard]] std::string page_drawing(const io::Report& report, const PartShapes* shapes);

}  // namespace trueflank
