// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `trochoid_interference`, one finding a mesh with a ring: where the tip circles cross, the pinion's
/// tip corner must pass before the ring's. Value: margin [deg] of the ring's rotation, with the real
/// tooth thicknesses. Warns where the exact profiles clear each other, else fails.
/// Source: derivation docs/interference.md; KHK's condition where there is no backlash.
[[nodiscard]] Findings check_trochoid_interference(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
