// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/modified_comparison.h"

namespace trueflank::test {
namespace {

TEST(ModifiedSimulation, AgreesOnTheFirstRandomDesigns) {
  const ModifiedComparison result = compare_modified(2000, 4, 3);
  EXPECT_EQ(result.wrong_verdicts, 0);
  EXPECT_GE(result.compared, 5);
  EXPECT_LT(result.largest_difference_mm, 1.5e-3);
}

}  // namespace
}  // namespace trueflank::test
