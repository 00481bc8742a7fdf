// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/export/report.h"
#include "trueflank/solid/part_shape.h"

namespace trueflank::app {

/// What the page draws, as JSON; does not look at the report's files.
/// shapes: null where the parts cannot be built; the bare toothings are drawn then.
[[nodiscard]] std::string html_drawing(const io::Report& report, const PartShapes* shapes);

/// report.html of a report, with its allowable torques.
[[nodiscard]] std::string html_document(const io::Report& report, const PartShapes* shapes);

}  // namespace trueflank::app
