// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/geometry/gear_pair.h"

namespace trueflank {

/// How far the mate's tip corner stays from the root of a gear while it passes through the gap, at
/// zero backlash: smallest distance along the circle [mm], over the root fillet and, where the mate's
/// tip reaches beyond the base circle's tangent point, over the flank above it. Negative: it cuts in.
/// Exact geometry, unlike the comparison of start of active profile and root form circle: an undercut
/// root often clears a tip that runs below its root form circle.
/// Accuracy: 1e-6 module, tested against turning the gears.
/// @{
[[nodiscard]] double corner_clearance_in_gear1_mm(const GearPair& pair);  ///< tip 2 in root 1
[[nodiscard]] double corner_clearance_in_gear2_mm(const GearPair& pair);  ///< tip 1 in root 2
/// @}

}  // namespace trueflank
