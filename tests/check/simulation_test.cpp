// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/simulation_comparison.h"

namespace trueflank::test {
namespace {

TEST(OverlapSimulation, AgreesOnTheFirstRandomDesigns) {
  const Comparison c = compare_with_simulation(1, 12);
  EXPECT_EQ(c.wrong, 0);
  EXPECT_EQ(c.exact_wrong, 0);
  EXPECT_GT(c.failing, 0);
}

}  // namespace
}  // namespace trueflank::test
