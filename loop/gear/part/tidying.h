// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What is still impossible in the end is not told.
void drop_impossible(PartModel& model);
/// Beside an effect with a shape (where a relief starts, how wide a hollow is) a small one may have
/// been chosen for what the shape's first value left. With the shape free it is nothing, and is not
/// told.
void drop_what_mends_a_shape(PartModel& model);
/// What a form without a name leaves looks a little like many things: beside one, a name must be as
/// sure as flips can say, or stand far above its error.
void drop_doubtful_names(PartModel& model);
/// An effect found on the left flanks and on the right ones, of one size, is one effect: of a
/// tooth, too, and if it stands out on one flank by as much as it lies back on the other, it
/// stands aside.
void join_flanks(PartModel& model);
/// Two names that together do what a third one does alone: equal slopes of all flanks and one of
/// the left flanks are opposite slopes.
void tell_two_names_as_one(PartModel& model);
/// A bow without a height of its own beside a bow with a name, which has one, are that bow and a
/// height. (Both pairs say the same: how well a height is told apart from a scale is the bow's,
/// too.)
void tell_bows_with_a_level(PartModel& model);
/// A form at the place of a far larger one of its kind is what the place of that leaves.
void drop_echoes_of_forms(PartModel& model);
/// A tooth that stands out on both flanks, and aside by as much, stands out on one.
void tell_teeth_of_one_flank(PartModel& model);
/// Forms that were found first may stand where fewer names say the same, or where the hold-out took
/// all of them back: all is chosen once more from names alone.
void prefer_names(PartModel& model);
/// Two that these data cannot tell from one and the same third are perhaps that: without the first
/// of them all is chosen once more.
void prefer_one_name_to_two(PartModel& model);
/// A name whose own interval holds zero, now that all else stands beside it, is no finding.
void drop_names_that_may_be_nothing(PartModel& model);
/// While structure is left, a name that does less than what is left, in every kind of record that
/// shows it, is as likely a part of that: it is told as a form, or not at all. So is a machine's
/// order that straight traces look like, and of an index what random places of few teeth may make.
void doubt_names_below_what_is_left(PartModel& model);
/// Forms that a better one, taken up later, made idle. True where there were any.
[[nodiscard]] bool drop_idle_forms(PartModel& model);

}  // namespace trueflank::loop
