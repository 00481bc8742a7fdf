// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What the data cannot show is not looked for under another name: shapes over the profile where
/// nothing was measured along it, over the face likewise.
void ban_what_cannot_be_seen(PartModel& model);
/// A ball in a gap does not move where both its walls do, and hardly where they do by nearly the
/// same: what a runout alone shows is told as a wave of the radius, not of the pitch.
void ban_pitch_in_runouts(PartModel& model);
/// True where values of one of its flanks differ in every direction in which the effect has a
/// course or a place: with all of them at one height its size would be that where nothing was
/// measured.
[[nodiscard]] bool is_within_reach(const PartModel& model, const Effect& effect);
/// What is given does not enter again, nor at a neighbouring shape.
void ban_given(PartModel& model);
/// Ids of effects that the data cannot show.
[[nodiscard]] std::vector<std::string> not_observable(const PartModel& model);
/// Bans named effects that cannot be meant: an amount of the wrong sign; a wave whose kin of the
/// same order remain unexplained, which is not that wave and is better described. True where any
/// was.
[[nodiscard]] bool ban_misnamed(PartModel& model);

}  // namespace trueflank::loop
