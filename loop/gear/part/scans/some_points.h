// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Forms of a large scan are sought in some of its points, and then fitted to all. True where that
/// explains all points: the answer is whole. False, and what was chosen stays, where something is
/// left that so few did not show, where the scan is not large, or where nothing was chosen that
/// needs a search: it is explained by all of them.
[[nodiscard]] bool explain_by_some_points(PartModel& model);

}  // namespace trueflank::loop
