// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// What one or two values of a trace say that lie far off by themselves: dirt, a wild point or a
/// short dent, which nothing else shows. A sentence each of the farthest three, and how many more
/// there are: where they lie, how high, and how to tell. `row_um`: residuals of the table's rows;
/// where a form without a name took a place up, nothing is left there. `told_um`: what the effects
/// say of a place. A value that was left out before the fit is no far one where they fall off
/// towards it from its neighbours as it does, by a third of it or more: the end of a relief.
/// A value is far where it lies seven of its trace's own errors off (of all traces', if these are
/// larger), or 5.5 with a neighbour at four: of normal errors one in 4e11, or one in 4e12.
[[nodiscard]] std::vector<std::string> notes_on_far_values(
    const FlankGeometry& geometry, const Observations& table, const std::vector<float>& row_um,
    const std::function<double(const Place&)>& told_um);

}  // namespace trueflank::loop
