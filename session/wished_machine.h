// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Gears with motor, housing, bearings and screws around them, scaled so that the housing has the
/// outer diameter; shifts and face widths stay. Guarantees nothing of walls, lengths and loads: the
/// checks tell. Requires: has_housing() of the train.
[[nodiscard]] GearboxDesign with_machine(GearboxDesign design, const Motor& motor,
                                         double outer_diameter_mm, double wall_mm);

}  // namespace trueflank
