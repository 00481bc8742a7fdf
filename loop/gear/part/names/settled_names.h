// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Forms change while an answer is found, and each rule that takes a name away knows those of its
/// time. In the end what says the same as a name gets it where it is settled.
void name_what_is_settled(PartModel& model);
/// Where structure is left in the end: a name of all teeth that takes it out, settled as well.
/// True where one does.
[[nodiscard]] bool name_what_is_left(PartModel& model);
/// What runs along the profile, or along the face, the same on every tooth, is told by the set of
/// names that costs least: what it leaves and how many values it needs, places included. Names were
/// chosen one after the other, and the first may have been one that follows two. Other sets that
/// cost hardly more are what it can be confounded with.
void tell_likeliest_names(PartModel& model);

}  // namespace trueflank::loop
