// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Rows of points near the bore that do not lie on its wall, such as those of a shoulder in it: far
/// from a cone that was fitted to the points of the same scan, however many agree with each other.
/// The wall stands for the axis of the part. Nothing where a scan has few such points.
[[nodiscard]] std::vector<std::uint32_t> rows_off_the_bore(const FlankGeometry& geometry,
                                                           const Observations& table);

}  // namespace trueflank::loop
