// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/check/cure_survey.h"

namespace trueflank::test {
namespace {

TEST(JointCureSurvey, NoneIsMadeWorseAndMostAreCured) {
  const CureSurvey survey = survey_cures(1000, 300);
  EXPECT_EQ(survey.worse, 0);
  EXPECT_EQ(survey.claims_broken, 0);
  EXPECT_GT(survey.cured, survey.failing * 2 / 3);
}

}  // namespace
}  // namespace trueflank::test
