// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Waves around the gear whose length changes, to start from: by what is left beside what stays and
/// each set of causes; of both flanks, opposite or alike.
[[nodiscard]] std::vector<Effect> stretching_waves_beside(
    const PartModel& model, const std::vector<Effect>& rest,
    const std::vector<std::vector<Effect>>& causes, bool opposite);
/// How many were looked at beside so many sets of causes.
[[nodiscard]] std::size_t looks_for_stretching_waves(const PartModel& model, std::size_t causes);

}  // namespace trueflank::loop
