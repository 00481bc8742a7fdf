// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/train/efficiency.h"

namespace trueflank {

/// Axial forces of a train driven at its input, per newton metre of torque there, the torque turning
/// the input counter-clockwise seen from +z; turned clockwise every sign changes.
struct AxialThrust {
  struct OfMesh {
    std::string name;
    double on_gear1_n_per_nm = kNaN;  ///< + along z, of one mesh (one planet); on gear 2 the opposite
  };
  struct OfBody {
    std::string name;  ///< sun, planet (one body, P1 and P2 together), ring1, ...
    double n_per_nm = kNaN;
  };
  std::vector<OfMesh> meshes;
  std::vector<OfBody> bodies;
};

/// A screw of a helical gear along its own helix moves no point of the tooth surface along the normal,
/// so the mesh does no work in it: F_z = -M tan(beta_b) / r_b, M being the torque of the mesh on the
/// gear. Rings and external gears alike. 0 for spur teeth and, over both halves, for herringbone.
/// M / r_b is taken as the mean of both gears, which friction makes differ; NaN where the train locks.
/// Source: derivation docs/theory/helical-trains.md.
[[nodiscard]] AxialThrust axial_thrust(const GearTrain& train, const DirectionEfficiency& forward);

}  // namespace trueflank
