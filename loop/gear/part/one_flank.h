// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// One flank worn or off by itself, told as both: a form of both flanks and the same opposite on
/// them; a comb of one flank as waves and a level; and, as a part may be turned about its axis, the
/// level of one flank as half of it on both. The last where the flank with it has forms of its own
/// and is somewhere as designed, and the other has none. So is a level of both that a wide form of
/// one takes out again: the other flank stands out.
void tell_what_one_flank_has(PartModel& model);
/// Two waves of one order that cancel on one flank are a wave of the other; swellings of one flank
/// that overlap are one as well.
void tell_waves_of_one_flank(PartModel& model);
/// One form for all that is opposite on the flanks along the profile or along the face: an S and a
/// turn of the section were a wave, a step was a bend. Where all else is told: beside waves that
/// are not understood yet, slopes look curved.
void tell_opposite_forms(PartModel& model);
/// A form of one flank, or of both in opposite directions, along the profile (0) or the face (1),
/// for what runs that way on any flank: slopes that turn the section and bows of either flank were
/// what it is made of. Or waves of one length on either flank, each in a phase of its own.
[[nodiscard]] bool tell_as_form_of_other_flanks(PartModel& model, int face);

}  // namespace trueflank::loop
