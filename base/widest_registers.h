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

}  // namespace trueflank
