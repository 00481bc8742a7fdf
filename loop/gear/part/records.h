// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What values one a tooth say alone and the joint answer lacks enters it, with the waves of slopes
/// in which traces may differ from it, or without them.
void hold_to_single_values(PartModel& model);
/// What a single value says of its tooth is no more than the errors of such values: where other
/// teeth reach nearly as far, or values along the traces are as far out now and then, it is one of
/// those.
void drop_teeth_within_the_tails(PartModel& model);

/// Where an effect's interval and that of values one a tooth alone have nothing in common: says so
/// in the notes, and the interval holds both.
void say_where_records_differ(const std::vector<FoundEffect>& alone, LoopResult& result);

}  // namespace trueflank::loop
