// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Where the joint cure starts again if nothing near a design passes, the nearest first: its rack half way to and at
/// ISO 53 profile A, then more teeth at about the same ratio (pairs: 9, 12, 17 on the smaller gear; sets that mesh
/// at equal spacing: twice as many), at the distance those ask for, with tips that are not written down. None where
/// the planets do not mesh at equal spacing; no other teeth where a housing stands around them.
[[nodiscard]] std::vector<GearboxDesign> farther_designs(const GearTrain& train);

}  // namespace trueflank
