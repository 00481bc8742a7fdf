// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/joint_cure.h"

#include <gtest/gtest.h>

#include "tests/check/check_designs.h"
#include "tests/check/cure_survey.h"
#include "tests/support/survey_size.h"
#include "trueflank/check/check_gearbox.h"

namespace trueflank {
namespace {

using test::gear;
using test::laid_out;
using test::only;
using test::pair_design;
using test::simple_design;

/// What the cure claims, judged again from its design alone.
void expect_cured(const JointCure& cure) {
  EXPECT_TRUE(cure.changed);
  ASSERT_TRUE(cure.cured()) << cure.conflict;
  for (const Finding& f : check_gearbox(laid_out(cure.design)))
    EXPECT_NE(f.status, CheckStatus::kFail) << f.id << " " << f.where << ": " << f.message;
}

TEST(JointCure, OneChangeForAnInternalPairWhoseChecksAskForThreeTips) {
  GearboxDesign design = pair_design(25, 29, true, 0.02);
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
}

TEST(JointCure, ShortensTheTipsWhereThatIsEnough) {
  GearboxDesign design = pair_design(12, 60, false, 0.1);
  design.gears[0].shift = design.gears[1].shift = 0.0;
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
  EXPECT_EQ(cure.design.gears[0].shift, 0.0);
  EXPECT_EQ(cure.design.centre_distance_mm, design.centre_distance_mm);
  EXPECT_EQ(cure.design.rack, design.rack);
}

TEST(JointCure, FitsShiftsToACentreDistanceTheyDoNotFit) {
  GearboxDesign design = pair_design(20, 40, false, 0.05);
  design.gears[0].shift = 0.3;
  design.gears[1].shift = 0.3;
  design.centre_distance_mm = 30.1;  // wants 30.55
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
  EXPECT_EQ(cure.design.gears[0].teeth, 20);
}

TEST(JointCure, TakesPlanetsAwayThatDoNotFit) {
  for (const int planets : {4, 15}) {  // three fit
    GearboxDesign design = simple_design(12, 40, 92, planets);
    design.backlash_mm = 0.05;
    const JointCure cure = joint_cure(laid_out(design));
    expect_cured(cure);
    EXPECT_LE(cure.design.planets, 3);
    EXPECT_GE(cure.design.planets, 2);
  }
}

TEST(JointCure, GivesAnAskedClearanceAtTheTeethItEndsWith) {
  GearboxDesign design = simple_design(16, 32, 81, 4);
  design.centre_distance_mm = 24.091;
  design.gears[0].shift = -0.093;
  design.gears[1].shift = -0.061;
  design.made.clearance_mm = 0.011;
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
  EXPECT_EQ(cure.design.gears[2].teeth, 80);
  EXPECT_LT(cure.design.backlash_mm, 0.03);
}

TEST(JointCure, AddsNoBacklashForATipThatStandsInARoot) {
  GearboxDesign design = pair_design(20, 40, false, 0.02);
  design.made.tolerance_class = 7;
  design.gears[0].tip_diameter_mm = 23.5;  // 1.5 modules too long
  design.gears[0].face_width_mm = design.gears[1].face_width_mm = 10.0;
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
  EXPECT_LT(cure.design.backlash_mm, 0.15);
}

TEST(JointCure, ChangesTeethWhereNothingElseAssembles) {
  GearboxDesign design = simple_design(13, 30, 73, 4);
  design.backlash_mm = 0.05;
  const JointCure cure = joint_cure(laid_out(design));
  expect_cured(cure);
  EXPECT_TRUE(laid_out(cure.design).assembly.equal_spacing);
}

TEST(JointCure, LeavesADesignAloneThatPasses) {
  GearboxDesign design = pair_design(24, 60, false, 0.1);
  design.tips = TipCircles::kClear;
  const JointCure cure = joint_cure(laid_out(design));
  EXPECT_FALSE(cure.changed);
  EXPECT_TRUE(cure.cured());
  EXPECT_EQ(cure.design, design);
}

TEST(JointCure, MakesNoRandomDesignWorseAndCuresMost) {
  const test::CureSurvey survey = test::survey_cures(1, test::survey_size(4, 12));
  EXPECT_EQ(survey.worse, 0);
  EXPECT_EQ(survey.newly_failing, 0);
  EXPECT_EQ(survey.claims_broken, 0);
  EXPECT_GT(survey.cured, survey.failing * 2 / 3);
}

}  // namespace
}  // namespace trueflank
