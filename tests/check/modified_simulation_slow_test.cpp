// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/modified_comparison.h"
#include "tests/support/survey_size.h"

namespace trueflank::test {
namespace {

TEST(ModifiedSimulation, AgreesOnTwentyFourRandomDesigns) {
  const int designs = survey_size(8, 24);
  const ModifiedComparison result = compare_modified(7000, designs, 3);
  EXPECT_EQ(result.wrong_verdicts, 0);
  EXPECT_GE(24 * result.penetrate, 2 * designs);
  EXPECT_LT(result.largest_difference_mm, 1e-3);
}

}  // namespace
}  // namespace trueflank::test
