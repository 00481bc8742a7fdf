// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/check/machine/machine_loads.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// Findings about the parts around the gears of a design with [housing] (docs/gearbox.md):
/// housing_size, wall, screws, shaft_grip, bearing_seat, bearing_load, collision, assembly_order. None of
/// another design.
[[nodiscard]] Findings check_machine(const GearTrain& train, const PartShapes& shapes);

}  // namespace trueflank
