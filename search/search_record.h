// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "trueflank/search/search_optimise.h"

namespace trueflank {

/// The optimised set of an index into SetEnumeration::sets, or stage of one into its `stages`.
struct SearchRecord {
  std::size_t index = 0;
  SetResult result;
};

/// Part `part` (1-based) of `parts`: the sets whose index leaves part - 1 when divided by parts; of
/// trains in series those with such a first stage.
struct SearchPart {
  int part = 1, parts = 1;
  [[nodiscard]] bool holds(std::size_t index) const {
    return index % static_cast<std::size_t>(parts) == static_cast<std::size_t>(part - 1);
  }
  /// Of so many sets.
  [[nodiscard]] std::size_t size(std::size_t sets) const {
    const auto first = static_cast<std::size_t>(part - 1), step = static_cast<std::size_t>(parts);
    return sets > first ? (sets - first + step - 1) / step : 0;
  }
  bool operator==(const SearchPart&) const = default;
};

}  // namespace trueflank
