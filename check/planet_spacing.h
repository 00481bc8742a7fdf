// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `planet_spacing`, one finding a layer: smallest distance [mm] between the tip circles, as built, of
/// neighbouring planets where they stand. Fails where they touch.
[[nodiscard]] Findings check_planet_spacing(const GearTrain& train);

/// Most planets of a tip radius that stand at equal spacing without touching.
[[nodiscard]] int most_planets(double centre_distance_mm, double tip_radius_mm);

}  // namespace trueflank
