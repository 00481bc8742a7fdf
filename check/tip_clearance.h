// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `tip_clearance`, one finding a mesh: the smaller of the two distances of a tip circle from the mate's
/// root circle [mm]. Fails below 0, warns below 0.1 module.
[[nodiscard]] Findings check_tip_clearance(const GearTrain& train);

}  // namespace trueflank
