// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/simulation_comparison.h"

namespace trueflank::test {
namespace {

TEST(OverlapSimulation, AgreesOnAThousandRandomDesigns) {
  const Comparison c = compare_with_simulation(100000, 1000);
  EXPECT_EQ(c.wrong, 0);
  EXPECT_EQ(c.exact_wrong, 0);
  // where two corners pass, the simulation's steps of 0.01 module cut the peak off
  EXPECT_LT(c.largest_difference_mm, 2.0 * kGreyZone_mm);
  EXPECT_GT(c.failing, 100);
  EXPECT_GT(c.shaper_rings, 100);
}

}  // namespace
}  // namespace trueflank::test
