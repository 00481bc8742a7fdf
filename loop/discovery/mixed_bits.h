// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace trueflank::loop {

/// A number as if drawn at random for the n-th of a row of things, the same every time
/// (splitmix64).
[[nodiscard]] inline std::uint64_t mixed_bits(std::uint64_t n, std::uint64_t start = 0) {
  std::uint64_t x = start + n * 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

}  // namespace trueflank::loop
