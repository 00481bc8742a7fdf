// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/strength.h"

// What every strength calculation needs to know of a mesh; for the sources of strength alone.
namespace trueflank {

/// Errors: kInconsistent where a material is not in the table.
[[nodiscard]] Result<const Material*> material_of(const StrengthOptions& options, const std::string& gear);

struct MeshGeometry {
  GearPair pair;
  double face_width_mm = kNaN;  ///< that carries
  double contact_ratio = kNaN;  ///< never below 1
  double overlap_ratio = 0.0;
  int count = 1;  ///< of equal meshes: planets
};
[[nodiscard]] MeshGeometry mesh_geometry(const GearTrain& train, const TrainMesh& mesh);

/// Z_H and Z_E of ISO 6336-2; JGMA has the same.
[[nodiscard]] double zone_factor(const MeshGeometry& mesh);
[[nodiscard]] double elasticity_factor(const Material& m1, const Material& m2);

/// A gear that is driven in one mesh and drives in another is bent both ways.
[[nodiscard]] bool passes_power_on(const GearTrain& train, const DirectionEfficiency& drive, int gear);
/// Torque of the output per torque of the input.
[[nodiscard]] double output_per_input(const GearTrain& train, const DirectionEfficiency& drive);

}  // namespace trueflank
