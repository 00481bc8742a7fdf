// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `involute_interference`, one finding a mesh: the mate's tip must not reach beyond the point where
/// the line of action touches the base circle. Value: roll length [mm] at first contact, of the worse
/// gear. Warns where the exact profiles clear each other, else fails.
/// Source: for a ring the same as KHK's z1/z2 >= 1 - tan a_a2 / tan a_w; derivation docs/interference.md.
[[nodiscard]] Findings check_involute_interference(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
