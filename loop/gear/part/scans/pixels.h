// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Sawteeth over x and y, far finer than a tooth, that a section of a scan has alike at every
/// height: pixels, steps of an axis. Empty where the flanks have nothing fine alike, or it has no
/// such period.
[[nodiscard]] std::vector<RemainderFinding> pixels_of_plane(const PartModel& model);

/// What flanks of a scan have alike at every height beside all that was told: told as what is left,
/// not as noise. True where there is some.
bool tell_pattern_alike_over_height(PartModel& model);

}  // namespace trueflank::loop
