// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// An eccentricity of its own of files whose index or runout differ by one: the gear was clamped
/// anew between them. Told from what the files say of the same flanks, so that nothing that the
/// gear has is taken for it. Empty: of one file, and where no file differs.
[[nodiscard]] std::vector<RemainderFinding> clampings_of_files(const PartModel& model);

/// Of an index alone, what comes once per turn and differs on the two flanks is either an
/// eccentricity and a wave of pitch, or a clamping for each flank: with as many numbers the same.
/// It is told as clampings where each flank has a file of its own, or where the two names would
/// have to take each other back on both flanks; else by the names.
void tell_clampings_of_flanks(PartModel& model);

}  // namespace trueflank::loop
