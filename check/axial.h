// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `axial`, one finding: smallest axial distance [mm] between parts of different layers that overlap
/// radially. Fails where they touch.
[[nodiscard]] Findings check_axial(const GearTrain& train);

}  // namespace trueflank
