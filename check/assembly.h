// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `assembly`, one finding: whether all planets mesh with sun and rings at once, by the closed form and by
/// turning the placed bodies; which angles assemble, and in which order the parts go together. Passes
/// for identical bodies at equal spacing, warns where the compound bodies differ, fails where equal
/// spacing is impossible. Value: angle [deg] by which the planets must leave equal spacing.
[[nodiscard]] Findings check_assembly(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
