// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A place of the body that stands out or lies back, for one tooth of both flanks or a sector that
/// was all that was told of it, or that is left: such a place dies away over its neighbours. True
/// where one stands for them.
[[nodiscard]] bool tell_lone_places(PartModel& model);

}  // namespace trueflank::loop
