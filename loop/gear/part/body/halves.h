// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Halves of a mould that stand aside, for what goes around the gear in several ways, on single
/// teeth and on all, with a size or without. Empty where they do not stand for it.
[[nodiscard]] std::vector<Effect> with_halves(const PartModel& model,
                                              std::vector<std::size_t>& these);

}  // namespace trueflank::loop
