// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/geometry/flank_deviation.h"
#include "trueflank/geometry/toothing.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// The design's modifications of one gear as a field on its flanks; the terms add. Empty where there
/// are none. What runs over the profile runs in roll length from root form to tip form circle, a
/// relief from its start diameter to the nearer of them; what runs over the face, in z. The halves of
/// a herringbone (without the groove) are faces of their own for crowning and helix slope, the upper
/// one the mirror image of the lower; end relief is at the outer ends.
/// Terms: docs/theory/modifications.md.
/// Errors, all of them, keys relative to the gear's table ("modifications.tip_relief_um"):
/// kInfeasible for a start diameter off the involute, a relief deeper than half the tip land (edge
/// chamfer included), a flank that would lean by more than kSteepestSlope.
[[nodiscard]] ResultAll<FlankDeviation> design_deviation(const ModificationsDesign& modifications,
                                                         const ToothProfile& profile,
                                                         const FaceTwist& face);

/// Steepest change of a deviation with roll length or height. Beyond it a flank is no flank, and
/// what treats deviations as small against the tooth no longer holds.
inline constexpr double kSteepestSlope = 0.2;

/// Whether any of the modifications is a deviation of the flanks.
[[nodiscard]] bool deviates(const ModificationsDesign& modifications);

/// Half the angle of the tip land that modifications and edge chamfer leave on either side at a
/// height, the smaller side [rad]; negative: the flank passes the tooth's middle.
[[nodiscard]] double tip_land_half_angle_rad(const Toothing& toothing, double z_mm);

}  // namespace trueflank
