// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "trueflank/loop/gear/local/flank_spots.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {

using IsFar = std::function<bool(std::size_t row, std::size_t side)>;

/// Points of a scan far from all others that lie together on one flank: a burr that only a few
/// points met, too few to move the mean of any window. Flanks are the classes of `rows`: 2 (tooth -
/// 1), and 1 more on the side +1. `is_far(row, side)`: whether a residual is far off. How often
/// far points have a far neighbour on the other flanks says what is usual: wild points that come in
/// clumps everywhere are no finding. One cluster of a flank, the largest.
[[nodiscard]] std::vector<FlankSpot> far_points_together(
    const FlankGeometry& geometry, const Observations& table, const RowsByClass& rows,
    std::size_t flanks, const std::vector<float>& row_um, const IsFar& is_far);

}  // namespace trueflank::loop
