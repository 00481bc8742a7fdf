// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// The assembly condition of the train's N planets in integers: sun and ring accept planets at
/// multiples of 1/(z_s + z_r) turn; identical compound bodies at the multiples k of it for which
/// k (z_r1 z_p2 - z_r2 z_p1) / (z_s + z_r1) is a multiple of gcd(z_p1, z_p2).
/// Source: derivation docs/theory/assembly.md; checked by turning in tests/train.
[[nodiscard]] AssemblyCondition assembly_condition(const GearTrain& train);

/// Phases at which all meshes are centred; see AssemblyPhases. Where the planets cannot stand at equal
/// spacing they stand at the nearest angles, and at equal spacing where there are none.
/// Requires: train.assembly is set.
[[nodiscard]] AssemblyPhases phases_in_mesh(const GearTrain& train);

}  // namespace trueflank
