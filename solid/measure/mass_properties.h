// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/inertia.h"

namespace trueflank {

/// Mass and inertia of a part of uniform density.
struct MassProperties {
  double volume_mm3 = 0.0;
  double mass_kg = 0.0;
  double axial_inertia_kg_m2 = 0.0;  ///< about the part's own axis z
};

/// Section by section from the outlines, every tooth, bore and hole; what changes over the face
/// (crowning, chamfers) by Gauss's rule between its breaks.
/// Accuracy: relative 1e-5, tested against closed forms and the integral over the part's mesh.
[[nodiscard]] MassProperties mass_properties(const PartShape& shape, double density_kg_m3);

/// Inertias of a train's bodies: of all made parts that turn with a member, in their places; of a
/// planet the mean of the bodies, about its own axis. What is bought (screws, bearings, pins) is left
/// out. `density_of` gives a part's density [kg/m3].
[[nodiscard]] BodyInertias body_inertias(const GearTrain& train, const PartShapes& shapes,
                                         const std::function<double(const PartShape&)>& density_of);

}  // namespace trueflank
