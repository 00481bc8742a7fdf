// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

// Meshes of modified flanks, by the sections of the real teeth.
namespace trueflank {

/// Whether a flank of the mesh deviates from its involute or helix.
[[nodiscard]] bool is_modified(const GearTrain& train, const TrainMesh& mesh);

/// Both gears of a mesh at one height, in the frame of their designs' sections.
struct PairSection {
  ToothProfile profile1, profile2;
  double centre_distance_mm = kNaN;
  double z_mm = kNaN;  ///< in the assembly

  [[nodiscard]] GearPair pair() const { return {&profile1, &profile2, centre_distance_mm}; }
};

/// The sections at one height; of unmodified gears those of the design.
[[nodiscard]] PairSection mesh_section(const GearTrain& train, const TrainMesh& mesh, double z_mm);

/// The sections that decide: at every height that another does not outdo in material on every flank. What
/// only gets worse with material is judged on them for the whole face. One where nothing is modified.
[[nodiscard]] std::vector<PairSection> decisive_sections(const GearTrain& train,
                                                         const TrainMesh& mesh);

/// The mesh turned in its decisive sections; `z_mm` of the results says where. The driving position is
/// that of the whole face, where the first flanks touch, on the worse side. Radial removal is not here.
[[nodiscard]] MeshState modified_state(const GearTrain& train, const TrainMesh& mesh);

/// Whether the pinion of a ring's mesh leaves it radially, with all its sections at once.
/// Requires: the mesh is a ring's.
[[nodiscard]] RadialRemoval modified_removal(const GearTrain& train, const TrainMesh& mesh);

/// A margin that only falls with material, the worst over the face.
[[nodiscard]] double worst_margin_rad(const GearTrain& train, const TrainMesh& mesh,
                                      double (*margin_rad)(const GearPair&));

/// The smallest clearance alone, for solvers.
[[nodiscard]] double modified_clearance_mm(const GearTrain& train, const TrainMesh& mesh);

}  // namespace trueflank
