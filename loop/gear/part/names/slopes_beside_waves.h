// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// In traces, beside waves that change their length and are not yet quite where they fit, a
/// straight slope looks bent at an end: it was told as a wear or a kink there. A slope that has a
/// name is told where it costs no more, the waves moved to where they fit beside it. Beside one
/// that is told already the waves are moved, and what is bent goes where that costs no more.
void tell_slopes_beside_waves(PartModel& model);

}  // namespace trueflank::loop
