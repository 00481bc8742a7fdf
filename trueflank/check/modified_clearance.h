// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Whether a flank of the mesh deviates from its involute or helix.
[[nodiscard]] bool is_modified(const GearTrain& train, const TrainMesh& mesh);

/// The mesh turned in its transverse sections, at every height that another does not outdo in material
/// on every flank; `z_mm` of the results says where. Helix slopes turn the sections against each
/// other; the driving position is that of the whole face, where the first flanks touch.
/// Ring roots and tips of sections are those of the design; removal is not looked at.
[[nodiscard]] MeshState modified_state(const GearTrain& train, const TrainMesh& mesh);

}  // namespace trueflank
