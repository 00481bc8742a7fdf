// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What runs along the profile, or along the face, the same on every tooth, is told by the set of
/// names that costs least: what it leaves and how many values it needs, places included. Names were
/// chosen one after the other, and the first may have been one that follows two. Other sets that
/// cost hardly more are what it can be confounded with.
void tell_likeliest_names(PartModel& model);

}  // namespace trueflank::loop
