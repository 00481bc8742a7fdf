// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `undercut`, one finding an external gear: warns where the tool cuts into the involute. Value: profile
/// shift; limit: the smallest shift without undercut. Source: the rack's straight flank must not reach
/// beyond the point where the line of action touches the base circle.
[[nodiscard]] Findings check_undercut(const GearTrain& train);

}  // namespace trueflank
