// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `fillet_interference`, one finding a mesh: start of active profile against root form circle, on both
/// gears [mm on the radius]. A sufficient criterion: where the exact profiles clear each other it
/// only warns; it fails where a tip does run into a root.
[[nodiscard]] Findings check_fillet_interference(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
