// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/always_inline.h"

// Loops that are compiled twice: for the registers every processor has, and for those of four
// doubles (AVX2). The same digits on every processor: the wider ones add the same numbers in the
// same order, without fused multiply-add, which would round otherwise
// (docs/decisions/0153-our-own-sine.md).
namespace trueflank {

#if defined(__x86_64__) && defined(__GNUC__)
template <class Work>
[[gnu::target("avx2")]] void in_wide_registers(const Work& work) {
  work();
}

/// Does `work()` in the widest registers there are. Its code is compiled twice where it is marked
/// as TRUEFLANK_ALWAYS_INLINE.
template <class Work>
void in_widest_registers(const Work& work) {
  if (__builtin_cpu_supports("avx2"))
    in_wide_registers(work);
  else
    work();
}
#else
template <class Work>
void in_widest_registers(const Work& work) {
  work();
}
#endif

/// Four numbers, for such loops; where the compiler, left to itself, takes one at a time. What such
/// a loop asks for beside arrays is best copied into variables of its own: what is captured may lie
/// in the arrays it writes.
using FourDoubles [[gnu::vector_size(4 * sizeof(double))]] = double;

/// The same anywhere in an array.
using FourInArray
    [[gnu::vector_size(4 * sizeof(double)), gnu::aligned(sizeof(double)), gnu::may_alias]] = double;

TRUEFLANK_ALWAYS_INLINE inline void load(FourDoubles& four, const double* from) {
  four = *reinterpret_cast<const FourInArray*>(from);
}
TRUEFLANK_ALWAYS_INLINE inline void store(const FourDoubles& four, double* to) {
  *reinterpret_cast<FourInArray*>(to) = four;
}

}  // namespace trueflank
