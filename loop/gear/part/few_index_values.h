// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A gear off its axis in an index of so few teeth, of one flank, that some of them held out would
/// leave too few to learn it from: an F test of all values.
[[nodiscard]] std::optional<RemainderFinding> eccentricity_of_few_values(const PartModel& model);

}  // namespace trueflank::loop
