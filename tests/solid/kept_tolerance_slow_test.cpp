// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many more random designs than measured_mesh_test.cpp has time for. TRUEFLANK_DESIGNS and
// TRUEFLANK_SEED ask for others.
#include <cstdlib>

#include "tests/solid/kept_tolerance.h"

namespace trueflank {
namespace {

std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(KeptTolerance, ByEveryPartOfRandomDesigns) {
  test::expect_tolerance_kept(asked("TRUEFLANK_SEED", 20),
                              static_cast<int>(asked("TRUEFLANK_DESIGNS", 500)));
}

}  // namespace
}  // namespace trueflank
