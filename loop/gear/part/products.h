// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// The answer with a product of simple courses, the last, in place of these; empty where none does.
[[nodiscard]] std::vector<Effect> with_products(const PartModel& model,
                                                std::vector<std::size_t>& these);

}  // namespace trueflank::loop
