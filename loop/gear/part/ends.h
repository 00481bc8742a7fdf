// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A form that is most at an end of profile or face: what its shape has before (its teeth) and
/// behind its own three values, and along what it runs towards which end.
struct FormAtAnEnd {
  bool of_teeth = false;
  std::vector<double> before, behind;
  double face = 0.0, end = 0.0;
};
/// None of another form, or of one that is alike at both ends.
[[nodiscard]] std::optional<FormAtAnEnd> form_at_an_end(const FlankGeometry& geometry,
                                                        const Effect& effect);

/// What stands out or lies back towards one end of profile or face, on all teeth or some: straight,
/// curved or dying away from the end, whichever leaves least.
void tell_ends_as_they_fit(PartModel& model);
/// What dies away from both ends alike, or curves towards both, for all that runs along profile or
/// face: a foot with a name and what stands out at the other end are no two things.
void tell_both_ends_as_one(PartModel& model);

}  // namespace trueflank::loop
