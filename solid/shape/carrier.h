// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// Adds the carrier of a design that has one to its parts and assembly: `carrier` (the lower plate),
/// `carrier_top` (the upper one) and `carrier_pin`, one at each planet.
/// Frame: each plate's lower face at z = 0, the first pin on +x; a pin stands on its end.
/// Errors: kInfeasible, all of them, where a pin does not fit its planet or a plate has no wall
/// between its holes; nothing is added then.
/// Of a carrier that drives a gear of the next stage the upper plate is one body with that gear, and no part
/// of its own.
[[nodiscard]] Errors add_carrier(const GearTrain& train, PartShapes& shapes);

/// Whether a carrier has a gear on it, the sun of the next stage.
[[nodiscard]] bool bears_gear(const Topology& topology, int carrier);

}  // namespace trueflank
