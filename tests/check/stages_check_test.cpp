// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/two_stage_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/check/tolerance_analysis.h"

namespace trueflank {
namespace {

using test::StageTeeth;

constexpr StageTeeth kFirst{.sun = 18, .planet = 36, .planets = 3, .module_mm = 0.8, .face_width_mm = 8.0};
constexpr StageTeeth kSecond{.sun = 20, .planet = 26, .planets = 4, .module_mm = 1.0, .face_width_mm = 14.0};

const Finding* find(const Findings& findings, const std::string& id, const std::string& where) {
  const auto it = std::find_if(findings.begin(), findings.end(),
                               [&](const Finding& f) { return f.id == id && f.where == where; });
  return it == findings.end() ? nullptr : &*it;
}

TEST(CheckStages, SaysOfEachWhatItSaysOfItAlone) {
  const auto whole = lay_out(test::two_stage_design(kFirst, kSecond));
  const Findings all = check_gearbox(*whole);
  for (int stage = 1; stage <= 2; ++stage) {
    const auto alone = lay_out(test::simple_design(stage == 1 ? kFirst : kSecond));
    const std::string number = std::to_string(stage);
    for (const Finding& expected : check_gearbox(*alone)) {
      if (expected.id == "axial") continue;
      std::string where = expected.where == "train" ? "stage" + number : expected.where + number;
      if (const auto dash = where.find('-'); dash != std::string::npos) where.insert(dash, number);
      const Finding* found = find(all, expected.id, where);
      ASSERT_NE(found, nullptr) << expected.id << " " << where;
      EXPECT_EQ(found->status, expected.status) << expected.id << " " << where;
      if (!std::isnan(expected.value)) {
        EXPECT_EQ(found->value, expected.value) << expected.id << " " << where;
      }
    }
  }
  std::set<std::string> seen;  // check by check
  std::string last;
  for (const Finding& finding : all) {
    if (finding.id != last) {
      EXPECT_TRUE(seen.insert(finding.id).second) << finding.id;
    }
    last = finding.id;
  }
}

TEST(CheckStages, PlanetsThatDoNotGoInAreOfTheirStage) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.later_stages[0].planets = 5;  // sun2 + ring2 = 92
  const Findings findings = check_gearbox(*lay_out(design));
  ASSERT_NE(find(findings, "assembly", "stage2"), nullptr);
  EXPECT_EQ(find(findings, "assembly", "stage2")->status, CheckStatus::kFail);
  EXPECT_EQ(find(findings, "assembly", "stage1")->status, CheckStatus::kPass);
}

TEST(CheckStages, StagesThatTouchFailByTheirHeights) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.layer_gap_mm = 0.0;
  const Findings findings = check_gearbox(*lay_out(design));
  ASSERT_NE(find(findings, "axial", "train"), nullptr);
  EXPECT_EQ(find(findings, "axial", "train")->status, CheckStatus::kFail);
  design.layer_gap_mm = 0.6;
  const Findings apart = check_gearbox(*lay_out(design));
  EXPECT_EQ(find(apart, "axial", "train")->status, CheckStatus::kPass);
  EXPECT_NEAR(find(apart, "axial", "train")->value, 0.6, 1e-12);
}

TEST(CheckStages, AJointChangeMendsTheStageThatFailsAndLeavesTheOther) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.tips = TipCircles::kStandard;
  design.gears[4].tip_diameter_mm = 30.2;  // deep in the roots of its mates
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  ASSERT_EQ(verdict(check_gearbox(*train)), CheckStatus::kFail);
  const JointCure cure = joint_cure(*train);
  EXPECT_TRUE(cure.cured()) << cure.conflict;
  EXPECT_TRUE(cure.changed);
  EXPECT_NE(verdict(check_gearbox(*lay_out(cure.design))), CheckStatus::kFail);
  EXPECT_EQ(cure.design.topology, design.topology);
  for (std::size_t g = 0; g < 3; ++g) EXPECT_EQ(cure.design.gears[g].teeth, design.gears[g].teeth);
}

TEST(CheckStages, ToleranceDrawsEveryPlanetOfBoth) {
  const auto whole = lay_out(test::two_stage_design(kFirst, kSecond));
  const auto one = lay_out(test::simple_design(kFirst)), two = lay_out(test::simple_design(kSecond));
  ToleranceOptions options;
  options.runout_um = 90.0;
  options.centre_distance_um = 60.0;
  options.sets = 4000;
  const auto share = [&](const GearTrain& train) { return 1.0 - analyse_tolerances(train, options)->jam_share; };
  const double apart = share(*one) * share(*two);
  EXPECT_GT(apart, 0.02);
  EXPECT_LT(apart, 0.98);
  EXPECT_NEAR(share(*whole), apart, 0.03);  // they jam independently
}

}  // namespace
}  // namespace trueflank
