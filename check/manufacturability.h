// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `manufacturability`: what the design's process cannot make, one finding a gear and one a mesh (its
/// backlash); none where the design names no process. Warns, never fails: limits of processes are
/// experience, not geometry.
[[nodiscard]] Findings check_manufacturability(const GearTrain& train);

/// Smallest radius of curvature of the concave root [mm]; 0: a sharp corner.
/// Accuracy: 1 % of it.
[[nodiscard]] double least_root_radius_mm(const ToothProfile& profile);
/// Width of the gap between two teeth at the root form circle [mm], as a chord.
[[nodiscard]] double least_gap_mm(const ToothProfile& profile);

}  // namespace trueflank
