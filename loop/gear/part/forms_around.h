// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Swellings that repeat (sinks at gates, ribs, jaws) are waves of an order and its multiples, and
/// a mean that may get a name; one tooth in three or more is a wave of that many teeth, and a mean.
[[nodiscard]] bool tell_as_repeating(PartModel& model);
/// Swellings that die away from an end are waves of an order and its multiples over the face, and
/// what runs over the face of all teeth; one alone, waves of many orders.
[[nodiscard]] bool tell_as_swellings_at_end(PartModel& model);
/// Values one a tooth alone (beside traces and scans they are asked by themselves:
/// hold_to_single_values), and slopes of traces that ended in pieces: told with one form that goes
/// from tooth to tooth where that costs clearly less.
void take_form_around(PartModel& model);
/// Waves of a scan that come again with every so many teeth, each tooth as it stands, are the
/// values of so many teeth that repeat: told as that pattern where it leaves no more. One wave by
/// itself is a pattern of three teeth, where it has more periods a turn than waves of machines
/// have; of more teeth it takes several waves.
void tell_waves_as_pattern(PartModel& model);

/// What is left of values one a tooth, as sure as can be, beside what was told: a second form from
/// tooth to tooth, that the choice of one did not lead to. True where one was added.
[[nodiscard]] bool add_form_that_is_left(PartModel& model);

}  // namespace trueflank::loop
