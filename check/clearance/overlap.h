// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `overlap`, one finding a mesh: the real profiles turned through a full mesh cycle with centred
/// backlash. Value: smallest clearance [um], negative for the deepest penetration. Fails below 0; flanks
/// that touch (within tolerance::kTouch_mm) pass. Every other interference check explains this one.
[[nodiscard]] Findings check_overlap(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
