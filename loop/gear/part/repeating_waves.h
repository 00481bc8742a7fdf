// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Waves of a scan that come again with every so many teeth, each tooth as it stands, are the
/// values of so many teeth that repeat: told as that pattern where it leaves no more. One wave by
/// itself is a pattern of three teeth, where it has more periods a turn than waves of machines
/// have; of more teeth it takes several waves.
void tell_waves_as_pattern(PartModel& model);

}  // namespace trueflank::loop
