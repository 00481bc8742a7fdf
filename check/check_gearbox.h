// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Every check of docs/checks.md on a laid-out train, in a fixed order, all findings.
[[nodiscard]] Findings check_gearbox(const GearTrain& train);
/// The same where the meshes have been turned already (one state a mesh, see mesh_states).
[[nodiscard]] Findings check_gearbox(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
