// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace trueflank {

/// A node of a patch of rows and columns: column, row.
using PatchNode = std::array<int, 2>;

/// Triangulates a patch of `columns` x `rows` steps with the nodes of its border alone: strips along
/// the diagonals, which fall (column down, row up) or rise. On an involute flank the straight
/// generators lie along them: what a step of a column turns, a step of a row turns back.
/// `column_step`, `row_step`: these turns; where they differ, each strip is cut so that its triangles
/// span the least of them.
/// Counter-clockwise with columns to the right and rows upwards; 2 (columns + rows) - 2 triangles.
[[nodiscard]] std::vector<std::array<PatchNode, 3>> strips(int columns, int rows, bool falling,
                                                           double column_step, double row_step);

}  // namespace trueflank
