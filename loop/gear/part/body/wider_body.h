// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// True where the scans have points of tips or roots.
[[nodiscard]] bool has_lands(const Observations& table);

/// A body that is wider along a part of its height, flanks, tips and roots moved outwards by one
/// amount, for what runs over the face and the sizes, leans and twists beside it.
[[nodiscard]] bool tell_as_wider_body(PartModel& model);

}  // namespace trueflank::loop
