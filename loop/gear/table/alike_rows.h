// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

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

}  // namespace trueflank::loop
