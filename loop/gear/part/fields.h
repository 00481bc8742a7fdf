// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Shifts by the square of the place are an eccentricity and waves of orders 1 and 3, of radius and
/// pitch: together they are tried against such a field, beside the eccentricity or without it.
[[nodiscard]] bool tell_as_field(PartModel& model);
/// What hangs on the direction that a flank faces is waves around the gear that are in other phases
/// on its two flanks; of flanks that face one side, also a mean and what looks like an
/// eccentricity, which is tried beside it too.
[[nodiscard]] bool tell_as_facing(PartModel& model);
/// Walls that face one side and stand out along a part of the height are, in pieces, an offset, a
/// taper, an eccentricity, a tilt and waves of either flank. One such form in place of these; empty
/// where none stands.
[[nodiscard]] std::vector<Effect> with_walls_of_one_side(const PartModel& model,
                                                         std::vector<std::size_t>& these);
/// A wave over the profile whose sign changes from tooth to tooth (a cutter of two starts) is every
/// other tooth's forms and orders that are half a multiple of the teeth.
[[nodiscard]] bool tell_as_alternating_wave(PartModel& model);
/// What one tooth in so many has along the profile or the face, a course or a wave, in place of
/// what differs there from tooth to tooth and of what all teeth have: a machine's orders, every
/// other tooth, and names that hold the mean. Empty where the data do not clearly show it.
[[nodiscard]] std::vector<Effect> with_comb(const PartModel& model,
                                            std::vector<std::size_t>& these);
/// Orders that are a half or a third of the teeth's multiples, beside teeth that differ by turns or
/// beside another such order, and orders near a multiple that are a slower wave's over the profile:
/// no machine's.
void tell_ghosts_of_teeth(PartModel& model);
/// A bow over the face that comes and goes around the gear and is none in the middle of the face
/// has a level of its own there, which is no wave of the pitch or the radius.
void tell_levels_of_bowed_waves(PartModel& model);

}  // namespace trueflank::loop
