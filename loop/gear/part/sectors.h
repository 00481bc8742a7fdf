// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A sector beside a large eccentricity is not seen before waves of many orders, single teeth and
/// the mean of all have taken it up: together they are tried against it, first with all that they
/// may have bent. So is a sector that stands already, with what is at its edges.
[[nodiscard]] bool tell_as_sector(PartModel& model);
/// The answer with a sector, the last, in place of these.
[[nodiscard]] std::vector<Effect> with_sector(PartModel& model, std::vector<std::size_t>& these);
/// Teeth that stand aside as one body, with what is at their ends, are all points of a scan towards
/// some directions: the edge between two views runs through teeth.
[[nodiscard]] bool tell_as_moved_part(PartModel& model);
/// Teeth side by side that stand out to one side are one swelling, hollow or sector, and none of
/// them a single tooth.
void tell_teeth_side_by_side(PartModel& model);

}  // namespace trueflank::loop
