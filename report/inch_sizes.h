// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/train/gear_train.h"

// The main sizes in inches, for designs whose files speak inches.
namespace trueflank::io {

/// A table for a terminal: centre distance; of each gear the diametral pitch (normal), the tip, root and form
/// diameters and the face width.
[[nodiscard]] std::string inch_table(const GearTrain& train);

/// The same as a JSON object: centre_distance_in, backlash_in of each mesh, gears.
[[nodiscard]] std::string inch_json_text(const GearTrain& train);

}  // namespace trueflank::io
