// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `backlash`, one finding a mesh: circumferential backlash [mm] at the working pitch circle as it comes
/// out, thinning included. Fails below 0.
[[nodiscard]] Findings check_backlash(const GearTrain& train);

}  // namespace trueflank
