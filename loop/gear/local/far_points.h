// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/loop/gear/local/flank_spots.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {

/// Points of a scan far from all others that lie together on one flank: a burr that only a few
/// points met, too few to move the mean of any window. Flanks are the classes of `rows`: 2 (tooth -
/// 1), and 1 more on the side +1. `far_um`: from where a residual is far, of either side. How often
/// far points have a far neighbour on the other flanks says what is usual: wild points that come in
/// clumps everywhere are no finding. One cluster of a flank, the largest.
[[nodiscard]] std::vector<FlankSpot> far_points_together(
    const FlankGeometry& geometry, const Observations& table, const RowsByClass& rows,
    std::size_t flanks, const std::vector<float>& row_um, const std::array<double, 2>& far_um);

}  // namespace trueflank::loop
