// SPDX-License-Identifier: GPL-3.0-or-later
//
// One program of libFuzzer a target: TRUEFLANK_FUZZ_TARGET is its name.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const trueflank::fuzz::Target* const target =
      trueflank::fuzz::find_target(TRUEFLANK_FUZZ_TARGET);
  if (target == nullptr) std::abort();
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
