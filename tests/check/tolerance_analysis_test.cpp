// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/tolerance_analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/check/clearance/clearance_field.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank::test {
namespace {

ToleranceResult analysed(const GearTrain& train, const ToleranceOptions& options) {
  auto result = analyse_tolerances(train, options);
  if (!result) throw std::runtime_error(result.error().message);
  return *result;
}

TEST(Tolerance, WithoutErrorsNothingChanges) {
  const GearTrain train = laid_out(paper_design(0.05));
  const ToleranceResult result = analysed(train, {.sets = 100});
  for (const MeshTolerance& mesh : result.meshes)
    EXPECT_NEAR(mesh.smallest_backlash_mm, 0.05, 1e-9);
  EXPECT_EQ(result.jam_share, 0.0);
}

TEST(Tolerance, ThicknessAndCentreDistanceEatTheBacklashAsTheTextbookSays) {
  GearboxDesign d = pair_design(25, 40, false, 0.1);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  const GearTrain train = laid_out(d);
  const ToleranceResult thick = analysed(train, {.tooth_thickness_um = 10, .sets = 100});
  EXPECT_NEAR(thick.meshes[0].smallest_backlash_mm, 0.08, 1e-9);
  const ToleranceResult near = analysed(train, {.centre_distance_um = 20, .sets = 100});
  EXPECT_NEAR(near.meshes[0].smallest_backlash_mm, 0.1 - 2.0 * 0.02 * std::tan(kPi / 9.0), 2e-4);
  const ToleranceResult wobble = analysed(train, {.runout_um = 20, .sets = 100});
  EXPECT_NEAR(wobble.meshes[0].smallest_backlash_mm, near.meshes[0].smallest_backlash_mm, 1e-9);
}

TEST(Tolerance, AClassGivesTheRunoutAndThePitchThatAreNotGivenThemselves) {
  const GearTrain train =
      laid_out(pair_design(30, 30, false, 0.1));  // equal gears: one table for both
  const TrainGear& gear = train.gears[0];
  const FlankTolerances standard =
      flank_tolerances(tolerance_size(gear.profile.gear(), gear.face_width_mm), 7).value();
  const auto figures = [&](ToleranceOptions options) {
    options.sets = 2000;
    const MeshTolerance mesh = analysed(train, options).meshes[0];
    return std::array{mesh.smallest_backlash_mm, mesh.smallest_clearance_mm, mesh.jam_share};
  };
  const double runout = standard.runout_um, pitch = standard.single_pitch_um;
  ASSERT_GT(figures({.runout_um = runout})[0],
            figures({.runout_um = runout, .pitch_um = pitch})[0] + 1e-3);
  EXPECT_EQ(figures({.tolerance_class = 7}), figures({.runout_um = runout, .pitch_um = pitch}));
  EXPECT_EQ(figures({.pitch_um = 30.0, .tolerance_class = 7}),
            figures({.runout_um = runout, .pitch_um = 30.0}));
  EXPECT_EQ(figures({.runout_um = 60.0, .tolerance_class = 7}),
            figures({.runout_um = 60.0, .pitch_um = pitch}));
}

TEST(Tolerance, TheBacklashAskedForIsWhatBacklashAndTwiceTheClearanceLack) {
  const GearTrain train = laid_out(pair_design(25, 40, false, 0.1));
  for (const auto& [backlash_mm, clearance_mm, asked_mm] :
       {std::array{0.05, -0.03, 0.16}, {-0.05, -0.02, 0.15}, {-0.05, -0.03, 0.16}}) {
    const ToleranceResult result{.meshes = {{.nominal_backlash_mm = 0.1,
                                             .smallest_backlash_mm = backlash_mm,
                                             .smallest_clearance_mm = clearance_mm,
                                             .jam_share = 0.5}},
                                 .jam_share = 0.5,
                                 .sets = 100};
    EXPECT_NEAR(told(check_tolerance(train, result)[0].cure, "backlash_mm of at least "), asked_mm,
                1e-3);
  }
}

TEST(Tolerance, ShareThatJamsIsTheNormalDistributionsTail) {
  // one error only: thickness of two gears, each with sigma 10 um; sum has sigma 14.1 um
  GearboxDesign d = pair_design(25, 40, false, 0.02);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  const GearTrain train = laid_out(d);
  const ToleranceResult result = analysed(train, {.tooth_thickness_um = 30, .sets = 40000});
  const double expected = 0.5 * std::erfc(20.0 / (10.0 * std::sqrt(2.0)) / std::sqrt(2.0));
  EXPECT_NEAR(result.jam_share, expected, 0.005);  // 4 standard errors, and the cut tails
  const Finding f = only(check_tolerance(train, result), "tolerance", "train");
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(f.value, 100.0 * result.jam_share, 1e-12);
  EXPECT_NEAR(f.margin, f.limit - f.value, 1e-12);
}

TEST(Tolerance, MorePlanetsJamMoreOften) {
  GearboxDesign d = paper_design(0.03);
  const ToleranceOptions options{.centre_distance_um = 30, .tooth_thickness_um = 15, .sets = 4000};
  const double three = analysed(laid_out(d), options).jam_share;
  d.planets = 1;
  EXPECT_GT(three, analysed(laid_out(d), options).jam_share);
}

TEST(Tolerance, ClearancesAreThoseOfTheTurnedTeethWhereSetsBeginToJam) {
  const GearTrain train = laid_out(paper_design(0.05));
  double worst_um = 0.0;
  int near = 0;
  for (const TrainMesh& mesh : train.meshes) {
    const GearPair pair = train.pair(mesh);
    constexpr double kWidth_mm = 0.15;
    auto field = ClearanceField::make(train, mesh, {}, {}, kWidth_mm);
    ASSERT_TRUE(field);
    for (int i = -30; i <= 30; ++i) {
      const double off_mm = kWidth_mm * i / 30.0;
      const double turned_um = 1e3 * sweep_clearance_mm({pair.profile1, pair.profile2, pair.centre_distance_mm + off_mm});
      if (std::abs(turned_um) > 5.0) continue;
      ++near;
      worst_um = std::max(worst_um, std::abs(1e3 * field->clearance_mm(off_mm, 0.0) - turned_um));
    }
  }
  EXPECT_GT(near, 5);
  EXPECT_LT(worst_um, 0.4);  // 4.5 with the nine places alone
}

TEST(Tolerance, TheSameSeedGivesTheSameShare) {
  const GearTrain train = laid_out(paper_design(0.03));
  const ToleranceOptions options{.centre_distance_um = 40, .tolerance_class = 8, .sets = 2000};
  EXPECT_EQ(analysed(train, options).jam_share, analysed(train, options).jam_share);
}

TEST(Tolerance, OutsideTheStandardsScopeIsAnError) {
  GearboxDesign d = paper_design(0.05);
  d.module_mm = 0.4;
  d.centre_distance_mm = 0.4 * 25.6826;
  const auto result = analyse_tolerances(laid_out(d), {.tolerance_class = 7});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kOutOfRange);
  EXPECT_FALSE(analyse_tolerances(laid_out(d), {.tooth_thickness_um = -1}));
}

TEST(Tolerance, TextIsReadOrRefused) {
  EXPECT_EQ(parse_tolerance("7")->tolerance_class, 7);
  const auto o = parse_tolerance("centre_distance_um=20,runout_um=12.5,class=8");
  ASSERT_TRUE(o);
  EXPECT_EQ(o->centre_distance_um, 20.0);
  EXPECT_EQ(o->runout_um, 12.5);
  for (const char* bad : {"", "seven", "runout=3", "runout_um=", "7.5", "class=7,", "runout_um=nan",
                          "1e300", "class=-1e19"})
    EXPECT_FALSE(parse_tolerance(bad)) << bad;
}

}  // namespace
}  // namespace trueflank::test
