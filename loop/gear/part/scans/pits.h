// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Many pits or lumps on scanned flanks are in the model from the start: a few of them would be
/// told as spots, and the others be left. They stay there.
void begin_with_pits(PartModel& model);
/// How sure they are, once all else is told.
void say_how_sure_pits_are(PartModel& model);

}  // namespace trueflank::loop
