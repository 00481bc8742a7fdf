// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/check/cure_survey.h"
#include "tests/support/survey_size.h"

namespace trueflank::test {
namespace {

/// 16, in the campaign 300, or as many as are asked for: docs/fix.md says what thousands give.
int designs() {
  const char* wanted = std::getenv("TRUEFLANK_CURE_DESIGNS");
  return wanted ? std::max(1, std::atoi(wanted)) : survey_size(16, 300);
}

TEST(JointCureSurvey, NoneIsMadeWorseAndMostAreCured) {
  const CureSurvey survey = survey_cures(std::getenv("TRUEFLANK_SEED") ? std::strtoull(std::getenv("TRUEFLANK_SEED"), nullptr, 10) : 1000, designs());
  EXPECT_EQ(survey.worse, 0);
  EXPECT_EQ(survey.newly_failing, 0);
  EXPECT_EQ(survey.claims_broken, 0);
  EXPECT_GT(survey.cured, survey.failing * 9 / 10);
}

TEST(JointCureSurvey, TheSearchOfACheckIsShort) {
  const CureSurvey survey = survey_cures(50000, std::min(designs() / 2, 60), kCheckSearch);
  EXPECT_EQ(survey.worse, 0);
  EXPECT_EQ(survey.newly_failing, 0);
  EXPECT_EQ(survey.claims_broken, 0);
  EXPECT_GT(survey.cured, survey.failing * 2 / 3);
}

}  // namespace
}  // namespace trueflank::test
