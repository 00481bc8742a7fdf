// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Rows of one place on a flank that differ by the tooth alone: of traces, those of all teeth at one height or
/// diameter. What is the same on every tooth (EffectFamily::same_on_every_tooth) is asked once for all of them.
struct AlikeRows {
  std::vector<std::uint32_t> first;  ///< of each kind its first row in the table
  std::vector<std::uint32_t> kind;   ///< of each row asked
};

/// Of some rows of the table, in their order. Rows of several places, and others than of flanks, are each a kind
/// of their own.
[[nodiscard]] AlikeRows alike_rows(const Observations& table, const std::vector<std::uint32_t>& rows);

/// How many parts the flanks are divided into over profile and face; 0: they are not.
struct FlankCells {
  int profile = 0, face = 0;
  bool operator==(const FlankCells&) const = default;
};

/// Of a scan, rows of one cell of the flanks, on the same side, as if all stood where the one
/// nearest to the middle of the cell stands; those on other surfaces by surface. For forms that act
/// on flanks alone and are the same on every tooth, as exact as cells are small.
[[nodiscard]] AlikeRows rows_of_cells(const FlankGeometry& geometry, const Observations& table,
                                      const std::vector<std::uint32_t>& rows, FlankCells cells);

}  // namespace trueflank::loop
