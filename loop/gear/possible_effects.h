// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/fit/point_fit.h"

namespace trueflank::loop {

/// False where an effect of a fit is none a gear can have: an amount of the wrong sign, a flank
/// moved by more than half a module, a name around the gear of which the data see next to nothing,
/// or a sum that is many times what was measured and that other effects take back.
[[nodiscard]] bool is_possible(const FlankGeometry& geometry, const PointFit& fit, int effect);

}  // namespace trueflank::loop
