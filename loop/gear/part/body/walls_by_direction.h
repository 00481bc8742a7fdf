// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Walls that stand out by the direction, seen from the axis, in which they stand: told for a wave
/// around the gear from tooth to tooth and what a name of its order took of the rest.
void tell_walls_by_direction(PartModel& model);

}  // namespace trueflank::loop
