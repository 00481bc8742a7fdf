// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `planet_spacing`, one finding a layer: smallest distance [mm] between the tip circles, as built, of
/// neighbouring planets where they stand. Fails where they touch.
[[nodiscard]] Findings check_planet_spacing(const GearTrain& train);

}  // namespace trueflank
