// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// Share of a deviated flank's turn that a place of the fillet keeps (see toothing.h): 1 where it meets
/// the flank, falling smoothly to 0 at its end. Of a protuberance's two pieces, side and trochoid, each
/// counts by its length.
/// Requires: a piece of kind kFillet.
[[nodiscard]] double fillet_turn_share(const ToothProfile& profile, std::size_t piece,
                                       double parameter);

}  // namespace trueflank
