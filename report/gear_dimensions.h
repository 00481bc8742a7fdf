// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/train/gear_train.h"

namespace trueflank::io {

/// Start of active profile of a gear of the train [mm radius]: the smallest of its meshes' for an
/// external gear, the largest for a ring; NaN for a gear without a mesh.
[[nodiscard]] double start_of_active_profile_mm(const GearTrain& train, const TrainGear& gear);

/// Why the span over k teeth cannot be measured on a gear; empty where it can: rings have no outer
/// flanks to span, and a helical gear needs more face width (herringbone: of one half) than the
/// measuring planes are apart along the axis.
[[nodiscard]] std::string span_obstacle(const TrainGear& gear, int teeth_spanned);

/// What the dimension over (between) pins is measured with: "pins", or "balls" where a straight pin
/// does not lie in the gap: helical rings, and helical gears with an odd number of teeth.
[[nodiscard]] std::string measured_with(const Gear& gear);

/// What a workshop measures of a gear whose teeth may differ; NaN: cannot be measured.
struct MeasuredLimits {
  double span_min_mm = kNaN, span_max_mm = kNaN;
  double over_pins_min_mm = kNaN, over_pins_max_mm = kNaN;  ///< of a ring between pins
};
/// Of teeth thinned by least_mm to most_mm (transverse, on the reference circle), by the spanned teeth and the pin that
/// are recommended for the gear.
[[nodiscard]] MeasuredLimits measured_limits(const TrainGear& gear, double least_mm, double most_mm);

}  // namespace trueflank::io
