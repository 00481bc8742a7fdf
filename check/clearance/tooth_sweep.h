// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

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

/// Whether sweep_both()'s clearance is at least so much: less work where it is, and much less where it is not.
[[nodiscard]] bool both_clear(const GearPair& pair, const GearDistance& gear1, const GearDistance& gear2,
                              double turn_rad, double turn_for_gear2_moving_rad, double least_mm);

/// The clearance of tip corners alone, or what stands in their place (rounding, trimmed corner): never less
/// than sweep_both()'s. Any value below `enough_mm` where it is below that. `spline_error`: GearDistance's.
[[nodiscard]] double tips_swept_mm(const GearPair& pair, double spline_error, double turn_rad,
                                   double turn_for_gear2_moving_rad, double enough_mm);

/// A point of the half tooth that is swept.
struct SweepSample {
  Point2 point;
  int piece;
  double parameter, low, high;  ///< neighbours on the piece, for refinement; equal for a corner
};

/// All ends of pieces as corners, and on every piece, in the order of the profile, places that lie evenly in its
/// parameter, ends included: as many as parts of a twentieth of the module (of an involute a tenth) and of a sag
/// of 2e-4 of the module ask for.
[[nodiscard]] std::vector<SweepSample> sweep_samples(const ToothProfile& profile);
/// Of those the tip corners, and the pieces that stand in their place.
[[nodiscard]] std::vector<SweepSample> tip_samples(const ToothProfile& profile);

/// The positions at which a tooth is looked at, and what moves how far between them.
struct SweepGrid {
  double reach_rad = 0.0;  ///< on either side of the line of centres; beyond it the tooth is clear of the mate's teeth
  double pitch_radius_mm = 0.0;  ///< of the mover: about that point of the line of centres the mate turns
  double turning = 0.0;          ///< of the mate against the mover, of the mover's own turning
  int steps = 0;  ///< no point of the tooth moves by much more than a twentieth of the module a step
};
[[nodiscard]] SweepGrid sweep_grid(const ToothProfile& mover, const ToothProfile& mate, double distance_mm);

/// How many columns ahead a distance stays above a limit that it exceeds by `above_mm`, where its
/// point moves by `first_mm` a column at first and by at most `growth_mm` more with every column.
[[nodiscard]] std::size_t columns_without(double above_mm, double first_mm, double growth_mm);

}  // namespace trueflank
