// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `assembly`, one finding: whether all planets mesh with sun and rings at once. Passes for identical
/// bodies at equal spacing, warns where the compound bodies differ, fails where equal spacing is
/// impossible. Value: angle [deg] by which the planets leave equal spacing.
[[nodiscard]] Findings check_assembly(const GearTrain& train);

}  // namespace trueflank
