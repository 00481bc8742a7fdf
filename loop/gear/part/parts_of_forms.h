// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A name that is a part of one odd form, and no cause of its own, is told as a form.
void tell_parts_of_a_form(PartModel& model);
/// The family without a name that an effect is told by in place of its name; null: none, or it was
/// told before, of other data, and stays as it is.
[[nodiscard]] const EffectFamily* form_instead(const PartModel& model, std::size_t e);
/// The form without a name of an effect that lifts all flanks: its own, or that of the commonest.
[[nodiscard]] const EffectFamily* form_of_level(const PartModel& model, std::size_t e);
/// True of what lifts all flanks and keeps its size where the forms without a name that are the
/// same on every tooth are not there, and these are: the tips, sizes or a lean that goes with it
/// show it, as a scale beside a hollow.
[[nodiscard]] bool is_shown_beside(const PartModel& model, std::size_t e,
                                   const std::vector<EffectShape>& terms);

}  // namespace trueflank::loop
