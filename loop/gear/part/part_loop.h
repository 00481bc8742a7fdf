// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// The procedure on one table: selection, shapes off the grid, finite displacements, single teeth,
/// and forms in place of pieces.
void explain_part(PartModel& model);

}  // namespace trueflank::loop
