// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Where the choice ends in pieces it is made again from other starts, and the best of these is
/// kept. True where that is in no pieces, leaves nothing and costs less: it is taken over, whole.
[[nodiscard]] bool begins_better(PartModel& model);
/// The best of other starts where it costs clearly less than what the choice came to by itself.
void take_other_start(PartModel& model);
/// The size of a part that nothing but its flanks shows stands for a thickness and a lean in one
/// ratio. Where forms over the profile mend it, the choice is made again without it, and taken over
/// where it needs fewer effects, or leaves clearly less.
void doubt_size_of_flanks(PartModel& model);

}  // namespace trueflank::loop
