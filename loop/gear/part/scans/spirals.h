// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A drift once around with a jump, in what the effects that are given leave of a scan: waves, odd
/// teeth and steps would follow it piece by piece. A drift from tooth to tooth where that leaves
/// hardly more.
[[nodiscard]] std::optional<RemainderFinding> spiral_of_flanks(const PartModel& model);

}  // namespace trueflank::loop
