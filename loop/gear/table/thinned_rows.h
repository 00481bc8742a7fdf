// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace trueflank::loop {

/// Of many rows about so many, in no rhythm with the lines of a scan.
class ThinnedRows {
 public:
  ThinnedRows(std::size_t count, std::size_t most)
      : below_(static_cast<std::uint64_t>(
            kAll * std::min(1.0, static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(1, count))))) {}

  [[nodiscard]] bool has(std::size_t row) const { return ((row * 2654435761ull) & 0xffffffffull) < below_; }

 private:
  static constexpr double kAll = 4294967296.0;
  std::uint64_t below_;
};

}  // namespace trueflank::loop
