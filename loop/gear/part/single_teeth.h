// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Level of a single tooth, counted over all teeth asked about. In a scan it is asked for at every
/// step of a choice, over heights, places and flanks, and errors that hang together make a flank
/// of their own: there noise must not make one of a few hundred gears.
[[nodiscard]] double level_of_tooth(const PartModel& model);
/// Single teeth once more with the hold-out: what stands in one tooth cannot be learnt from others.
void look_at_single_teeth(PartModel& model);
/// Takes out teeth of scans that stand within what the scatter of the scan's own flanks makes of so
/// many teeth and flanks: means of flanks may agree with each other better than that by chance.
void drop_teeth_within_their_error(PartModel& model);
/// The effects that held-out values alone show: what stands on one held-out tooth no other value
/// can foretell. Empty where there are none, and where there are so many that they would follow
/// held-out values whatever these are: more than one form of either flank, but for forms of one and
/// the same tooth.
[[nodiscard]] std::vector<std::size_t> shown_by_held_out_alone(
    const PartModel& model, const PointFit::HeldOutBesideLocal& held_out);
/// Sizes are few and know their own error: what they say of thickness, which traces with zeros of
/// their own cannot show, is judged by chi-square.
void look_at_sizes(PartModel& model);
/// What stands over a few teeth is no wave: many small terms, none of which is found by itself. Nor
/// is it a single tooth where the teeth beside it share it.
void look_at_neighbours(PartModel& model);
/// What neighbouring teeth share of what effects leave, and whether that is more than chance.
[[nodiscard]] SharedByNeighbours shared_beside(const PartModel& model,
                                               const std::vector<Effect>& effects);
[[nodiscard]] bool is_shared(const PartModel& model, const SharedByNeighbours& shared);
/// True where neighbouring teeth share what the effects leave, beyond chance.
[[nodiscard]] bool neighbours_share(const PartModel& model);
/// What stands on one tooth is told as one form of it where that says as much: bent from its root
/// on, thicker towards its tip, swollen. And what stands on the two walls of one gap is told of the
/// gap: heights of its walls were what it is made of, or one of them with all that runout shows.
/// Spots of neighbouring teeth are one swelling over these where that says as much with fewer
/// values.
void tell_one_tooth_or_gap(PartModel& model);

}  // namespace trueflank::loop
