// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What stands on one tooth is told as one form of it where that says as much: bent from its root
/// on, thicker towards its tip, swollen. And what stands on the two walls of one gap is told of the
/// gap: heights of its walls were what it is made of, or one of them with all that runout shows.
/// Spots of neighbouring teeth are one swelling over these where that says as much with fewer
/// values.
void tell_one_tooth_or_gap(PartModel& model);

}  // namespace trueflank::loop
