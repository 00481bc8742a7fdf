// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// Whether a key gets to every screw at the step of the order at which it is put in, and what it
/// turns into is there by then: a finding a group of screws, and one for the set screw.
[[nodiscard]] Findings check_access(const GearTrain& train, const MachineLayout& layout,
                                    const PartShapes& shapes, const AssemblyOrder& order);

}  // namespace trueflank
