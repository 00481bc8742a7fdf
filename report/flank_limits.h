// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/train/gear_train.h"

namespace trueflank::io {

/// JSON text of the flank tolerances of ISO 1328-1:2013 of a gear [um]: "classes" 1 ... 11, each symbol with its limit;
/// "scope": null, or why the standard has none for this gear.
[[nodiscard]] std::string flank_limits_json_text(const TrainGear& gear);

}  // namespace trueflank::io
