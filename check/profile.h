// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `profile`, one finding a gear: warns of everything the tooth could not be as asked (pointed tooth,
/// reduced root rounding, closed ring space, radial tip, trimmed tip). Value: how many such things.
[[nodiscard]] Findings check_profile(const GearTrain& train);

}  // namespace trueflank
