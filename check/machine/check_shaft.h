// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// How deep the motor's shaft is in what it drives, and what carries its torque there.
[[nodiscard]] Finding shaft_grip(const GearTrain& train, const MachineLayout& layout);

}  // namespace trueflank
