// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// A range of heights in the assembly [mm].
struct HeightRange {
  double lower_mm = 0.0, upper_mm = 0.0;
};

/// The carrier of a train, sized: two plates below and above the planets, held by the pins on which
/// the planets turn. Each plate has an opening about the axis and, where asked for, the seat of a
/// bearing in its outer face.
struct CarrierLayout {
  double pin_diameter_mm = kNaN;
  double pin_hole_diameter_mm = kNaN;  ///< in the plates
  double outer_diameter_mm = kNaN;
  double opening_diameter_mm = kNaN;
  double seat_diameter_mm = 0.0;  ///< 0: no seat
  double seat_depth_mm = 0.0;
  HeightRange lower_plate, upper_plate;  ///< in the assembly
  [[nodiscard]] HeightRange pins() const { return {lower_plate.lower_mm, upper_plate.upper_mm}; }
};

/// Sizes the carrier of a design that has one; nothing where it has none or no planets.
[[nodiscard]] std::optional<CarrierLayout> carrier_layout(const GearTrain& train);

}  // namespace trueflank
