// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// The procedure on one table: selection, shapes off the grid, finite displacements, single teeth,
/// and forms in place of pieces.
void explain_part(PartModel& model);
/// The same of a part that is told as it is then: choices are compared in the weights of what was
/// measured, and what is left is asked in those beside narrow forms.
void explain_measured_part(PartModel& model);

}  // namespace trueflank::loop
