// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/modified_comparison.h"

namespace trueflank::test {
namespace {

TEST(ModifiedSimulation, AgreesOnTwentyFourRandomDesigns) {
  const ModifiedComparison result = compare_modified(7000, 24, 3);
  EXPECT_EQ(result.wrong_verdicts, 0);
  EXPECT_GE(result.penetrate, 2);
  EXPECT_LT(result.largest_difference_mm, 1e-3);
}

}  // namespace
}  // namespace trueflank::test
