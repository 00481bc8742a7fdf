// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/check/mesh_clearance.h"

namespace trueflank {

/// Distances below this are reported as 0.
inline constexpr double kZero_mm = 1e-9;

/// The counter-clockwise half tooth of either gear turned through the whole mesh against the other gear;
/// the lowest place of both sweeps, without the exact verdict. With centred backlash the clockwise halves
/// are the mirror image. `gear1`, `gear2`: distances from the pair's profiles. Gear 2 is turned out of the
/// centred position, by an angle of its own where gear 2 is the one that moves.
/// Accuracy: mesh_clearance()'s.
[[nodiscard]] MeshClearance sweep_both(const GearPair& pair, const GearDistance& gear1,
                                       const GearDistance& gear2, double turn_rad,
                                       double turn_for_gear2_moving_rad);

/// The clearance of tip corners alone, or what stands in their place (rounding, trimmed corner): never less
/// than sweep_both()'s. Any value below `enough_mm` where it is below that. `spline_error`: GearDistance's.
[[nodiscard]] double tips_swept_mm(const GearPair& pair, double spline_error, double turn_rad,
                                   double turn_for_gear2_moving_rad, double enough_mm);

}  // namespace trueflank
