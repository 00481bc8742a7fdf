// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `trimming_interference`, one finding a mesh with a ring: passes where the pinion can leave radially
/// at every rotation, else warns: axial assembly. Value: margin [deg] of the textbook criterion.
/// Source: derivation docs/interference.md; KHK's condition where there is no backlash.
[[nodiscard]] Findings check_trimming_interference(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
