// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Moves the points of scans that lie in the datum's frame back by an eccentricity that stands out
/// before anything is chosen: from where they lie all would be chosen, and then once more from
/// there.
void move_back_what_is_off_centre(PartModel& model);
/// Chooses until neither shapes nor places nor poses move any more, some rounds.
void explain(PartModel& model);
/// Places, widths, poses and displacements of what is chosen, by these values.
void settle_as_chosen(PartModel& model);
/// Of scans: values on the slopes of narrow forms scatter by where they lie there. Beside these
/// forms they count as others do, and places and widths are sought once more. True where that is
/// so.
[[nodiscard]] bool weigh_beside_forms(PartModel& model);
/// What is smaller than the rounding of 32-bit mesh files is no finding, however regular it is.
[[nodiscard]] bool is_rounding(const PartModel& model);
/// Columns of candidates that stayed as they were are kept.
[[nodiscard]] DiscoveryProblem& candidates_problem(PartModel& model);
/// Adds columns of effects that are fitted whatever is selected.
void add_nuisance(DiscoveryProblem& problem, const DiscoveryProblem& fitted);
/// What the choice left may be gone since other effects stand in its place: the test is made again
/// beside these.
void ask_what_is_left(PartModel& model);

}  // namespace trueflank::loop
