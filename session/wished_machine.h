// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Gears with motor, housing, bearings and screws around them, scaled so that the housing has the
/// outer diameter; shifts and face widths stay. Where no housing is made for the train, what is
/// driven gets the bore of the motor's shaft and nothing else is changed. Guarantees nothing of
/// walls, lengths and loads: the checks tell.
[[nodiscard]] GearboxDesign with_machine(GearboxDesign design, const Motor& motor,
                                         double outer_diameter_mm, double wall_mm);

}  // namespace trueflank
