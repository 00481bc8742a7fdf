// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// A lower bound [um] of the error that any pose leaves of the deviations of the gear as designed
/// (the plain fit's rms): what the best one leaves of some thousand points of the scans, shared out
/// over all values. 0 where there are no scans.
[[nodiscard]] double least_plain_rms_um(const FlankGeometry& geometry, const Observations& table,
                                        const Patches& patches);

}  // namespace trueflank::loop
