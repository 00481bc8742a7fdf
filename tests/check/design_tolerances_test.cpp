// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/design_tolerances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/cure/joint_cure.h"

namespace trueflank::test {
namespace {

GearboxDesign pair_with(double backlash_mm) {
  GearboxDesign d = pair_design(20, 41, false, backlash_mm);
  d.tips = TipCircles::kClear;
  for (GearDesign& g : d.gears) g.face_width_mm = 10.0;
  return d;
}

TEST(DesignTolerances, WhatTheDesignAsksForFailsAndTheJointCureMendsIt) {
  GearboxDesign d = pair_with(0.0);
  EXPECT_TRUE(check_design_tolerance(laid_out(d)).empty());
  d.made.tolerance_class = 7;
  d.made.axis_tolerance_mm = 0.01;
  const GearTrain train = laid_out(d);
  const Finding whole = only(check_gearbox(train), "tolerance", "train");
  EXPECT_EQ(whole.status, CheckStatus::kFail);
  EXPECT_GT(whole.value, 50.0);
  EXPECT_NE(whole.message.find("ISO class 7, axes +-10 um"), std::string::npos) << whole.message;
  EXPECT_NE(whole.message.find("assemble and run"), std::string::npos) << whole.message;
  const JointCure cure = joint_cure(train);
  ASSERT_TRUE(cure.cured()) << cure.conflict;
  EXPECT_GT(cure.design.backlash_mm, 0.0);
  EXPECT_LT(cure.design.backlash_mm, 0.2);
  EXPECT_NE(only(check_gearbox(laid_out(cure.design)), "tolerance", "train").status, CheckStatus::kFail);
}

TEST(DesignTolerances, WhatOnlyTheProcessSaysWarns) {
  GearboxDesign d = pair_with(0.0);
  d.made.process = *ProcessTable().find("fdm-0.4");
  const Finding none = only(check_gearbox(laid_out(d)), "tolerance", "train");
  EXPECT_EQ(none.status, CheckStatus::kWarn);
  EXPECT_GT(none.value, 50.0);
  d.backlash_mm = d.made.process->backlash_mm;
  const Finding wanted = only(check_gearbox(laid_out(d)), "tolerance", "train");
  EXPECT_LE(wanted.value, wanted.limit) << wanted.message;
  EXPECT_EQ(wanted.status, CheckStatus::kPass) << wanted.message;
  EXPECT_EQ(lacking_backlash_mm(laid_out(pair_with(0.0))), 0.0);
}

TEST(DesignTolerances, EveryProcessRunsWithTheBacklashItRecommends) {
  const ProcessTable processes;
  int judged = 0;
  for (const Process& process : processes.all()) {
    GearboxDesign d = pair_with(process.backlash_mm);
    d.made.process = process;
    if (process.source == "no limits") {  // a name for the loop's causes: nothing is said of its tolerances
      EXPECT_FALSE(design_tolerances(laid_out(d))) << process.name;
      continue;
    }
    ++judged;
    const Finding f = only(check_design_tolerance(laid_out(d)), "tolerance", "train");
    EXPECT_LE(f.value, f.limit) << process.name << ": " << f.message;
  }
  EXPECT_GE(judged, 7);
}

TEST(DesignTolerances, OutsideTheStandardsScopeTheProcessCountsByItsRunoutAndAnAskedClassIsToldSo) {
  GearboxDesign d = pair_with(0.05);
  d.module_mm = 0.3;  // below ISO 1328-1
  d.made.process = *ProcessTable().find("cnc-hobbing");
  const auto tolerances = design_tolerances(laid_out(d));
  ASSERT_TRUE(tolerances);
  EXPECT_FALSE(tolerances->options.tolerance_class);
  EXPECT_NEAR(*tolerances->options.runout_um, 30.0, 1e-9);
  d.made.tolerance_class = 7;
  const Finding f = only(check_design_tolerance(laid_out(d)), "tolerance", "train");
  EXPECT_EQ(f.status, CheckStatus::kNotApplicable);
  EXPECT_NE(f.message.find("ISO class 7"), std::string::npos) << f.message;
}

TEST(DesignTolerances, TheClearanceThatIsAskedForIsKeptOrFails) {
  GearboxDesign d = pair_with(0.05);
  d.made.clearance_mm = 0.02;
  const Finding kept = only(check_gearbox(laid_out(d)), "overlap");
  EXPECT_EQ(kept.status, CheckStatus::kPass) << kept.message;
  EXPECT_NEAR(kept.limit, 20.0, 1e-9);
  d.backlash_mm = 0.01;
  const GearTrain train = laid_out(d);
  const Finding less = only(check_gearbox(train), "overlap");
  EXPECT_EQ(less.status, CheckStatus::kFail);
  EXPECT_NEAR(less.value, 1e3 * 0.5 * 0.01 * std::cos(rad_from_deg(20.0)), 0.1);
  const JointCure cure = joint_cure(train);
  ASSERT_TRUE(cure.cured()) << cure.conflict;
  EXPECT_GE(only(check_gearbox(laid_out(cure.design)), "overlap").value, 20.0 - 1e-6);
}

}  // namespace
}  // namespace trueflank::test
