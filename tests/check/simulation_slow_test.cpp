// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/simulation_comparison.h"
#include "tests/support/survey_size.h"

namespace trueflank::test {
namespace {

TEST(OverlapSimulation, AgreesOnHundredsOfRandomDesigns) {
  const Comparison c = compare_with_simulation(100000, survey_size(50, 1000));
  EXPECT_EQ(c.wrong, 0);
  EXPECT_EQ(c.exact_wrong, 0);
  // where two corners pass, the simulation's steps of 0.01 module cut the peak off
  EXPECT_LT(c.largest_difference_mm, 2.0 * kGreyZone_mm);
  EXPECT_GT(c.failing, c.designs / 10);
  EXPECT_GT(c.shaper_rings, c.designs / 10);
}

}  // namespace
}  // namespace trueflank::test
