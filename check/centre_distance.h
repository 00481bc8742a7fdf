// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `centre_distance`, one finding a mesh: the backlash [mm] that given shifts and centre distance imply,
/// thinning aside. Fails where it is negative (beyond the rounding of four decimals) or above a quarter
/// of the module.
[[nodiscard]] Findings check_centre_distance(const GearTrain& train);

}  // namespace trueflank
