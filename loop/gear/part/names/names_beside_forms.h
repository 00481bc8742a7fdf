// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// The flank (0: left, 1: right) that shows a name of both flanks by itself, beyond doubt: the
/// forms without a name leave it alone, and the other flank, which they change, does not deny the
/// name.
[[nodiscard]] std::optional<int> flank_that_shows(const PartModel& model, const PointFit& fit,
                                                  std::size_t e, bool face);
/// Along most of every flank that a name runs over, the forms without a name are flat (a step, a
/// kink or a bulge stands elsewhere): there the name stands by itself. So it does beside rises and
/// bulges that have no part of its course: a bell mouth at both ends has no slope.
[[nodiscard]] bool stands_on_every_flank(const PartModel& model, const PointFit& fit,
                                         std::size_t e);
/// As stands_on_every_flank, or where one flank shows the name alone, beside forms of the other.
[[nodiscard]] bool stands_beside_forms(const PartModel& model, const PointFit& fit, std::size_t e);
/// A slope or a bow stands by itself beside the one form that there is along its flanks where that
/// has no part of its course, as an S or a bow has no slope, and no form that bends, steps, rises
/// or comes in waves says both.
[[nodiscard]] bool stands_beside_one_form(const PartModel& model, const PointFit& fit,
                                          std::size_t e, bool face);
/// Names without a place that run along the profile (0) or the face (1), of either flank or alike
/// on both, or opposite on them, too; of those that run alike the one first that such data are told
/// by.
[[nodiscard]] std::vector<Effect> names_along(const PartModel& model, int face,
                                              bool opposite_too = false);
/// Of names that run alike, the one with the lowest preference is what such data are told by.
[[nodiscard]] int preference_of(const PartModel& model, const Effect& name);
/// Names with a place over the profile at all their places, a list for each: alone, and beside the
/// slopes among these.
[[nodiscard]] std::vector<std::vector<std::vector<Effect>>> names_with_a_place(
    const PartModel& model, const std::vector<Effect>& straight);
/// A form with a place whose whole course a name follows as well: a step that was all that could be
/// seen of a slope beside a wave not yet understood, or a curve towards the tip beside a slope,
/// which is a relief.
void name_forms_beside_names(PartModel& model);
/// A slope or a bow that stands beside forms which leave most of the flank alone, or run the other
/// way, gets its name where the data do not deny it.
void name_terms_beside_forms(PartModel& model);
/// Ends rounded by a brush are a crowning, plating that grows at an edge is a pressure angle error,
/// as near as one value tells. Where one form along the same direction leaves clearly less than
/// such a name, it is told in its place. True where one was.
bool tell_as_form_for_a_name(PartModel& model);

}  // namespace trueflank::loop
