// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace trueflank {

/// Asks the system to hold memory in pages of 2 MB instead of 4 KB. To be called before it is filled, for arrays of
/// many megabytes that are filled whole: each page that is touched first costs a call of the system, and reading across
/// small pages costs look-ups. Only pages that lie in the array as a whole are asked for, so it takes no more memory. A
/// hint: where the system has no such pages, nothing changes.
inline void ask_for_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
  const auto from = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (from + kPage - 1) / kPage * kPage, end = (from + bytes) / kPage * kPage;
  if (first < end) static_cast<void>(madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE));
#endif
}

/// Has the pages within an array made ready, which costs a call of the system each where they are
/// touched first: on another thread than the one that fills them. They count as used from then on,
/// so only what is sure to be filled is to be asked for. A hint, as above.
inline void make_pages_ready([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  constexpr std::uintptr_t kPage = std::uintptr_t{1} << 12;
  const auto from = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (from + kPage - 1) / kPage * kPage,
                       end = (from + bytes) / kPage * kPage;
  if (first < end)
    static_cast<void>(madvise(reinterpret_cast<void*>(first), end - first, MADV_POPULATE_WRITE));
#endif
}

}  // namespace trueflank
