// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/prototype_design.h"

// The paper: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403.
namespace trueflank {
namespace {

EfficiencyResult efficiency_of(const GearboxDesign& design, const EfficiencyOptions& options = {}) {
  auto train = lay_out(design);
  EXPECT_TRUE(train.has_value()) << train.error().front().message;
  return efficiency(*train, options);
}

/// The paper's equations straight from tooth numbers, shifts and tip circles, with nothing of ours.
double paper_basic(double z1, double z2, bool internal, double tip1, double tip2, double a_w,
                   double mu) {
  const double a0 = 20 * std::acos(-1.0) / 180, pi = std::acos(-1.0);
  const auto tangent = [&](double tip, double z) { return std::tan(std::acos(z * std::cos(a0) / tip)); };
  const double sign = internal ? -1 : 1;
  const double e1 = sign * z2 / (2 * pi) * (tangent(tip2, z2) - std::tan(a_w));
  const double e2 = z1 / (2 * pi) * (tangent(tip1, z1) - std::tan(a_w));
  return 1 - mu * pi * (1 / z1 + sign / z2) * (e1 * e1 + e2 * e2 - e1 - e2 + 1);
}

TEST(Efficiency, UncorrectedPrototypeIsThe685PercentOfThePaper) {
  // mu = 0.1, layer 1 unshifted (a = 25.5 m), x_r2 = 0, x_p2 = -1.1360
  const GearboxDesign design = test::prototype(0.0, 0.0, 25.5);
  auto train = lay_out(design);
  ASSERT_TRUE(train.has_value());
  EXPECT_NEAR(train->gears[3].shift, -1.1360, 5e-5);
  EXPECT_NEAR(efficiency(*train).forward, 0.6852, 5e-5);
}

TEST(Efficiency, OptimumOfThePrototypeTeethIsAbove908Percent) {
  // rough search without interference limits: about 90.9 % forward, 90.3 % backward near
  // x_r1 = 0.46, x_r2 = 2.0, a = 25.69 m
  const EfficiencyResult result = efficiency_of(test::prototype(0.46, 2.0, 25.69));
  EXPECT_NEAR(result.forward, 0.909, 0.001);
  EXPECT_NEAR(result.backward, 0.903, 0.001);
  EXPECT_FALSE(result.self_locking);
}

TEST(Efficiency, MeshesFollowThePapersTipCirclesAndFormula) {
  const GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
  auto train = lay_out(design);
  ASSERT_TRUE(train.has_value());
  const double a = 25.66, a0 = rad_from_deg(20.0);
  const double w1 = std::acos(25.5 * std::cos(a0) / a), w2 = std::acos(24.5 * std::cos(a0) / a);
  const double ya = 25.5 * (std::cos(a0) / std::cos(w1) - 1);
  std::vector<double> x;
  for (const TrainGear& gear : train->gears) x.push_back(gear.shift);
  const double d_s = 12 + 2 * (1 + ya - x[1]), d_p1 = 39 + 2 * (1 + std::min(ya - x[0], x[1]));
  const double d_r1 = 90 - 2 * (1 - x[2]), d_p2 = 32 + 2 * (1 + x[3]), d_r2 = 81 - 2 * (1 - x[4]);
  const EfficiencyResult result = efficiency(*train);
  EXPECT_NEAR(result.basic_efficiency_of("sun-planet1"),
              paper_basic(12, 39, false, d_s, d_p1, w1, 0.1), 1e-12);
  EXPECT_NEAR(result.basic_efficiency_of("planet1-ring1"),
              paper_basic(39, 90, true, d_p1, d_r1, w1, 0.1), 1e-12);
  EXPECT_NEAR(result.basic_efficiency_of("planet2-ring2"),
              paper_basic(32, 81, true, d_p2, d_r2, w2, 0.1), 1e-12);
}

TEST(Efficiency, EfficiencyIsLostMeshByMesh) {
  const EfficiencyResult result = efficiency_of(test::prototype(0.46, 1.2, 25.66));
  for (const DirectionEfficiency* drive : {&result.forward_drive, &result.backward_drive}) {
    double losses = 0.0;
    for (const auto& mesh : drive->meshes) losses += mesh.loss;
    EXPECT_NEAR(1 - drive->efficiency, losses, 1e-12);
  }
  EXPECT_EQ(result.forward_drive.meshes[2].driving_gear, "ring2");
  EXPECT_EQ(result.backward_drive.meshes[2].driving_gear, "planet2");
}

TEST(Efficiency, HighFrictionLocksTheTrainBackward) {
  EfficiencyOptions options;
  options.friction = 0.3;
  const EfficiencyResult result = efficiency_of(test::prototype(0.0, 0.0, 25.5), options);
  EXPECT_TRUE(result.self_locking);
  EXPECT_EQ(result.backward, 0.0);
  EXPECT_GT(result.forward, 0.2);
  EXPECT_LT(result.forward, 0.5);  // the rule of the inclined surface: locks below one half
}

TEST(Efficiency, SpeedsAgreeWithTheKinematicsOfTheTrain) {
  for (const OutputMember output : {OutputMember::kRing2, OutputMember::kRing1}) {
    GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
    design.output = output;
    auto train = lay_out(design);
    ASSERT_TRUE(train.has_value());
    const MemberSpeeds w = member_speeds(*train);
    for (const auto& member : efficiency(*train).forward_drive.members) {
      const double expected = member.name == "sun"       ? 1.0
                              : member.name == "planet"  ? w.planet
                              : member.name == "carrier" ? w.carrier
                              : member.name == "ring1"   ? w.ring1
                                                         : w.ring2;
      EXPECT_NEAR(member.speed, expected, 1e-14) << member.name;
    }
  }
}

TEST(Efficiency, ASingleGearHasNone) {
  const EfficiencyResult result =
      efficiency_of(test::unshifted(TrainKind::kGear, OutputMember::kNone, {20}));
  EXPECT_TRUE(std::isnan(result.forward));
  EXPECT_TRUE(result.meshes.empty());
}

TEST(Efficiency, PathIntegralIsNearTheFormulaForStandardTeeth) {
  const GearboxDesign design = test::unshifted(TrainKind::kPair, OutputMember::kWheel, {24, 60});
  const EfficiencyResult formula = efficiency_of(design);
  const EfficiencyResult exact = efficiency_of(design, {.model = LossModel::kPathIntegral, .friction = {}});
  EXPECT_TRUE(formula.meshes[0].formula_applies);
  EXPECT_NEAR(formula.forward, exact.forward, 0.05 * (1 - formula.forward));
  EXPECT_NE(formula.forward, exact.forward);
}

}  // namespace
}  // namespace trueflank
