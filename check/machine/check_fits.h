// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Classes and limits of the seats of a gearbox, as far as it has some, and whether its process holds
/// them; none of another.
[[nodiscard]] Findings check_fits(const GearTrain& train);

}  // namespace trueflank
