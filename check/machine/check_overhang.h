// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// What of every made part hangs free as it lies on the bed, against what the process prints
/// without support; nothing where it has no such limits.
[[nodiscard]] Findings check_overhangs(const GearTrain& train, const PartShapes& shapes);

}  // namespace trueflank
