// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "trueflank/base/arc_tangent.h"

// Four arc tangents at once, in wide registers (widest_registers.h): the digits that
// base/elementary_functions.cpp gives for one number. For sources compiled with -Wno-psabi; always
// inlined (arc_tangent.h says why).
namespace trueflank {

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
using FourWords [[gnu::vector_size(4 * sizeof(std::int64_t))]] = std::int64_t;
using FourInts [[gnu::vector_size(4 * sizeof(std::int32_t))]] = std::int32_t;

[[gnu::always_inline]] inline bool all(const FourWords& is) {
  return (is[0] & is[1] & is[2] & is[3]) != 0;
}
[[gnu::always_inline]] inline Four sizes(const Four& x) {
  return reinterpret_cast<Four>(reinterpret_cast<FourWords>(x) & INT64_MAX);
}
/// As the sign bit says, also of zeros.
[[gnu::always_inline]] inline FourWords are_negative(const Four& x) {
  return reinterpret_cast<FourWords>(x) < 0;
}

/// Of 0 <= x <= 1, and what is no number.
[[gnu::always_inline]] inline Four arc_tangents_below_one(const Four& x) {
  const Four sixteenths = x >= 0.0625 ? x * 16.0 + 0.5 : Four{};
  const FourInts i = __builtin_convertvector(sixteenths, FourInts);
  const Four c = __builtin_convertvector(i, Four) / 16.0;
  const Four high{kAtanTable[i[0]][0], kAtanTable[i[1]][0], kAtanTable[i[2]][0],
                  kAtanTable[i[3]][0]},
      low{kAtanTable[i[0]][1], kAtanTable[i[1]][1], kAtanTable[i[2]][1], kAtanTable[i[3]][1]};
  return arc_tangent_beside(x, c, high, low);
}
/// That of `of_inverse`'s inverse.
[[gnu::always_inline]] inline Four beyond_one(const Four& of_inverse) {
  return 0.5 * kPiHigh - (of_inverse - 0.5 * kPiLow);
}
/// Of what is not negative.
[[gnu::always_inline]] inline Four arc_tangents(const Four& x) {
  const FourWords is_beyond = x > 1.0;
  const Four value = arc_tangents_below_one(is_beyond ? 1.0 / x : x);
  return is_beyond ? beyond_one(value) : value;
}
/// Of y / x in the quadrant of (x, y). Requires: all are numbers.
[[gnu::always_inline]] inline Four arc_tangents(const Four& y, const Four& x) {
  const Four ax = sizes(x), ay = sizes(y);
  const FourWords is_steep = ay > ax;
  const Four less = is_steep ? ax : ay, more = is_steep ? ay : ax;
  Four value = arc_tangents_below_one(more > 0.0 ? less / more : Four{});
  value = is_steep ? beyond_one(value) : value;
  value = are_negative(x) ? kPiHigh - (value - kPiLow) : value;
  return are_negative(y) ? -value : value;
}

}  // namespace trueflank
