// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Spots and heights of one tooth are told as one lean, bow, step or rise of it where that says as
/// much with fewer values; both flanks together first.
void tell_forms_of_teeth(PartModel& model);
/// What stood beside the pieces is asked again beside the form; what was sought among many places
/// or orders must stand far above its error.
void tell_forms_of_some_teeth(PartModel& model);
/// A form along the flanks beside a sector of teeth on the same flanks is one that these teeth
/// have: waves around the gear, and orders of a machine, were what made of it one of all teeth.
void tell_forms_of_sectors(PartModel& model);

/// What is left of every row, with what these effects say added.
[[nodiscard]] std::vector<double> left_with(const PartModel& model,
                                            const std::vector<std::size_t>& these);
/// A form along the flanks of a run of teeth, with sharp or soft edges, in place of the forms
/// without a name that differ along the flanks, or beside them: where that costs least.
[[nodiscard]] std::vector<Effect> with_form_on_teeth(const PartModel& model,
                                                     std::vector<std::size_t>& these,
                                                     double& p_value);

/// True where a form of a run of teeth was nearly undone by one that all teeth have: the other
/// teeth have it, and these have nothing.
[[nodiscard]] bool tell_of_the_other_teeth(PartModel& model);

}  // namespace trueflank::loop
