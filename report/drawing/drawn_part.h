// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/drawing/workshop_drawings.h"

// What a drawing says of a part besides its shape.
namespace trueflank::io {

struct DrawnMaterial {
  std::string name;
  double mass_kg = kNaN;
  std::string mass_text;  ///< "12.3 g"
};
/// Material of a part's gears (of the gearbox for a part without) and the mass that follows.
[[nodiscard]] DrawnMaterial material_of(const DrawingModel& model, const PartShape& part);

/// "planet_2" as a person writes it: "Planet 2".
[[nodiscard]] std::string proper_name(const std::string& part);
/// The flank modifications of a gear in a sentence; empty: none.
[[nodiscard]] std::string modification_text(const GearTrain& train, const std::string& gear);

}  // namespace trueflank::io
