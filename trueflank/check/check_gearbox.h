// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Every check of docs/checks.md on a laid-out train, in a fixed order, all findings.
[[nodiscard]] Findings check_gearbox(const GearTrain& train);

}  // namespace trueflank
