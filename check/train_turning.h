// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// The mesh of one planet that stands worst out of phase while the whole train turns.
struct TrainTurning {
  double phase_error_mm = 0.0;  ///< arc on the working pitch circle, out of the centred position
  std::string mesh;             ///< with the number of the planet, "planet2-ring2 of planet 3"
  double clearance_mm = kNaN;   ///< of the profiles there, over a mesh cycle
};

/// Turns the train by its kinematics and looks at every mesh of every planet at once: are the teeth
/// where the others need them? Independent of the closed-form assembly condition: only positions and
/// rotations of the placed bodies are used.
[[nodiscard]] TrainTurning turn_train(const GearTrain& train, const std::vector<MeshState>& states);

}  // namespace trueflank
