// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A slope of one flank beside another slope of either: where the smaller of the two flanks' is no
/// crumb, both kinds of slope of all flanks, a lean and a taper, are told. That is as many values
/// and the same sum, and causes that act on all flanks are the usual ones.
void tell_one_flank_as_two_names_of_all(PartModel& model);
/// Two forms without a name, each of teeth that the other leaves alone, and together as good as a
/// name: they are that name and one of them, the smaller, if that is anything beside it.
void tell_names_in_two_parts(PartModel& model);
/// What leans moves in one of two ways (its sections, or as a body), and the choice may settle the
/// wrong one first: the wave that makes up for it is nothing beside the right one.
void drop_what_mends_another_way(PartModel& model);
/// Of names that say the same beside the others, the usual one is told: a scale and a lean of
/// traces may be a helix error and another lean.
void tell_the_usual_of_equals(PartModel& model);
enum class Names { kOfBothFlanks, kOfEitherToo };
/// The answer with a name more, the last: of all teeth, without a place, told apart and possible,
/// the one that leaves least, and less than `below` of chi-square. Empty: none does.
[[nodiscard]] std::vector<Effect> with_best_name(const PartModel& model, double below, Names which);
/// Takes it over.
void add_name(PartModel& model, std::vector<Effect> with);
/// Names of all teeth that the choice passed over, as small beside the others as they are, where
/// each takes out clearly more than chance: up to so many values.
void add_names(PartModel& model, int most_values);

}  // namespace trueflank::loop
