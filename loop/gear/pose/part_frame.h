// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/measured/measurement.h"
#include "trueflank/train/gear_train.h"

namespace trueflank::loop {

/// Aligned scans of a whole compound planet stand in the frame of the part, in which planet2 lies above
/// planet1: those that fit the gear there, and not where its own frame has it, are moved into the gear's
/// frame, and told. Scans that fit in the gear's frame stay. No change for gears that begin at z = 0.
void move_into_gear_frame(const GearTrain& train, const TrainGear& gear, const FlankGeometry& geometry,
                          MeasuredData& data);

}  // namespace trueflank::loop
