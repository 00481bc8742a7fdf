// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// The answer with a product of simple courses, the last, in place of these; empty where none does.
[[nodiscard]] std::vector<Effect> with_products(const PartModel& model,
                                                std::vector<std::size_t>& these);
/// A corner of the flanks of one side, or of both, for all that is the same on every tooth: slopes
/// of both flanks, alike and opposite, are one of one side. A name may stand beside it.
[[nodiscard]] bool tell_as_corner(PartModel& model);
/// What grows over the profile times over the face, for two or more that are the same on every
/// tooth: a taper, a twist and a bow of a cure that reaches less far down.
[[nodiscard]] bool tell_as_product(PartModel& model);

/// A form along one direction that comes and goes in the other one, for waves that it weighs and
/// the mean that these have beside them: ridges of one bad tooth of a hob.
[[nodiscard]] bool tell_as_swelling_form(PartModel& model);

/// The answer with a form along traces that grows from nothing across them, the last, in place of
/// these, where profiles were traced at several heights or leads at several diameters: a hollow
/// that is deeper towards one end was told as its mean, with a name. Empty where none says clearly
/// more.
[[nodiscard]] std::vector<Effect> with_form_growing_across(const PartModel& model,
                                                           std::vector<std::size_t>& these);

}  // namespace trueflank::loop
