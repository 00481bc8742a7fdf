// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `contact_ratio`, one finding a mesh: what root form circles and undercut leave of the transverse
/// contact ratio, plus the overlap ratio of helical teeth. Fails below 1, warns below 1.1.
[[nodiscard]] Findings check_contact_ratio(const GearTrain& train);

}  // namespace trueflank
