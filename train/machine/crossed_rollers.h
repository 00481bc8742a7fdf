// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/machine/elements.h"

namespace trueflank {

/// Crossed-roller bearings: one alone holds loads in every direction and tilting moments.
[[nodiscard]] const std::vector<Bearing>& crossed_roller_bearings();

/// Whether a bearing is one of them, by its name: a user's numbers for it may be others.
[[nodiscard]] bool is_crossed_roller(const Bearing& bearing);

}  // namespace trueflank
