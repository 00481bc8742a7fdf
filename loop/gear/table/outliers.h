// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Leaves out of the table what lies far from its neighbours on the same flank (an effect moves
/// them together), and counts it. On all processors; the same rows on any number of them.
void leave_out_outliers(const FlankGeometry& geometry, Observations& table);

}  // namespace trueflank::loop
