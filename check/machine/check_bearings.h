// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// A finding with its margin and status: at its limit it passes, at `least` it warns, below it fails.
[[nodiscard]] Finding judged(Finding finding, double least);

/// bearing_seat and bearing_load of a design with [housing].
[[nodiscard]] Findings check_bearings(const GearTrain& train, const MachineLayout& layout);

}  // namespace trueflank
