// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Which rows of a table are of scanned flanks, in order, of those that are used: gathered once for
/// all searches that look at some of them.
[[nodiscard]] inline std::vector<std::uint32_t> scanned_flank_rows(const Observations& table,
                                                                   const std::vector<bool>& used) {
  std::vector<std::uint32_t> rows;
  if (!table.points_mm.empty()) rows.reserve(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (used[i] && table.rows[i].kind == ObservationKind::kScanFlank)
      rows.push_back(static_cast<std::uint32_t>(i));
  return rows;
}

}  // namespace trueflank::loop
