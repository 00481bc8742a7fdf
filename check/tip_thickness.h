// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Arc at the tip circle [mm] where the gear's modifications leave least of it over the face; the edge
/// chamfer, at the very ends, aside.
[[nodiscard]] double least_tip_thickness_mm(const TrainGear& gear);

/// `tip_thickness`, one finding a gear: warns below 0.2 module. Value: arc at the tip circle [mm], at
/// the involute's end for a trimmed tip.
[[nodiscard]] Findings check_tip_thickness(const GearTrain& train);

}  // namespace trueflank
