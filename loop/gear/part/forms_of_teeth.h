// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Spots and heights of one tooth are told as one lean, bow, step or rise of it where that says as
/// much with fewer values; both flanks together first.
void tell_forms_of_teeth(PartModel& model);
/// What stood beside the pieces is asked again beside the form; what was sought among many places
/// or orders must stand far above its error.
void tell_forms_of_some_teeth(PartModel& model);
/// A form along the flanks beside a sector of teeth on the same flanks is one that these teeth
/// have: waves around the gear, and orders of a machine, were what made of it one of all teeth.
void tell_forms_of_sectors(PartModel& model);

}  // namespace trueflank::loop
