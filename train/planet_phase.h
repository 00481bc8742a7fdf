// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// The assembly condition of the train's N planets in whole numbers, z negative for rings. Turned by
/// phi round the train's axis a planet gear z_p sees the teeth of a mate z pass by phi z; so a gear
/// between two mates z, z' meshes with both at multiples of 1/|z - z'| turn, and a compound body whose
/// gears mesh with z1 and z2 is the same body at the phi for which phi (z1 z_p2 - z2 z_p1) is a
/// multiple of gcd(z_p1, z_p2) turns.
/// Source: derivation docs/theory/assembly.md; checked by turning in tests/train.
/// Where equal spacing is impossible the nearest angles are those of identical bodies, or, where these would
/// collide, of indexed ones; the offsets are those at the angles given.
[[nodiscard]] AssemblyCondition assembly_condition(const GearTrain& train);

/// Bodies that stand at other angles than identical ones could, because their later gears are turned against
/// the first ones by offsets of their own (an index).
struct IndexedPlanets {
  std::vector<double> angles_rad;   ///< nearest to equal spacing; empty where neighbours would collide
  std::vector<double> offsets_rad;  ///< of the second gear, as AssemblyCondition::planet_offsets_rad
};
/// Empty where indexing frees no angle: planets with one gear, or places that identical bodies have too.
[[nodiscard]] IndexedPlanets indexed_planets(const GearTrain& train);

/// Bodies at the angles that are taken differ by no offset.
[[nodiscard]] bool planet_bodies_alike(const AssemblyCondition& condition);

/// Phases at which all meshes are centred; see AssemblyPhases. Where the planets cannot stand at equal
/// spacing they stand at the nearest angles, and at equal spacing where there are none.
/// Requires: train.assembly is set.
[[nodiscard]] AssemblyPhases phases_in_mesh(const GearTrain& train);

}  // namespace trueflank
