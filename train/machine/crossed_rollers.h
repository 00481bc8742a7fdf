// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/machine/elements.h"

namespace trueflank {

/// The built-in crossed-roller bearings.
[[nodiscard]] const std::vector<Bearing>& crossed_roller_bearings();

}  // namespace trueflank
