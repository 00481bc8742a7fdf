// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Where flanks of one side alone were measured: names that leave as much as one that is told,
/// which the other side would tell from it, are told with it; one that a flank can have alone
/// first.
void tell_names_that_one_side_leaves_open(PartModel& model);

}  // namespace trueflank::loop
