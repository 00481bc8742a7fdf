// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Where some points of scans stand aside at random among the others, as where two scans that do
/// not fit were laid over each other, they are moved back and all is explained anew: their mean
/// looks like an eccentricity, the rest like noise. What is told of them; nothing where there are
/// none.
[[nodiscard]] std::optional<RemainderFinding> explain_without_points_aside(PartModel& model);

}  // namespace trueflank::loop
