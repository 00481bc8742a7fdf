// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gear_train.h"

namespace trueflank::io {

/// Start of active profile of a gear of the train [mm radius]: the smallest of its meshes' for an
/// external gear, the largest for a ring; NaN for a gear without a mesh.
[[nodiscard]] double start_of_active_profile_mm(const GearTrain& train, const TrainGear& gear);

}  // namespace trueflank::io
