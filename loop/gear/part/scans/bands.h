// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Bands that come again over the face, or a flight of steps, in what the effects that are given
/// leave: waves and their multiples would follow them piece by piece.
[[nodiscard]] std::optional<RemainderFinding> bands_of_flanks(const PartModel& model);

}  // namespace trueflank::loop
