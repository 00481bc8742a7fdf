// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Of the answers in which one of the forms stands for one of these sets, the one that costs least.
/// It says most of what the set does: many places that errors made have so many values that a form
/// which says nothing would be worth it. Empty where none does.
[[nodiscard]] std::vector<Effect> cheapest_one_form(
    const PartModel& model, const std::vector<std::vector<std::size_t>>& sets,
    const std::vector<Effect>& forms, const std::vector<Effect>& beside,
    std::vector<std::size_t>& these);
/// Whole forms in place of the pieces that were taken up one by one, and all else chosen anew
/// beside them.
void explain_with_whole_forms(PartModel& model);

}  // namespace trueflank::loop
