// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/prototype_design.h"
#include "tests/support/train_members.h"

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
  const EfficiencyResult result = efficiency(*train);
  EXPECT_NEAR(result.by_formula.forward, 0.6852, 5e-5);
  EXPECT_FALSE(result.by_formula.applies);
  // e1 = 2.56, e2 = -0.71 in planet1-ring1: what its teeth really slide is less than the formula says
  EXPECT_NEAR(result.forward, 0.805, 5e-4);
}

TEST(Efficiency, SelfLockingByTheFormulaAloneIsNone) {
  const GearboxDesign design = test::tooth_set({12, 39, 90, 35, 84}, {0.2, 0.2}, 25.6, 0.15);
  const EfficiencyResult result = efficiency_of(design);
  EXPECT_TRUE(result.by_formula.self_locking);
  EXPECT_FALSE(result.by_formula.applies);
  EXPECT_FALSE(result.self_locking);
  EXPECT_NEAR(result.backward, 0.17, 0.005);
}

TEST(Efficiency, OptimumOfThePrototypeTeethIsAbove908Percent) {
  // rough search without interference limits: about 90.9 % forward, 90.3 % backward near
  // x_r1 = 0.46, x_r2 = 2.0, a = 25.69 m
  const FormulaEfficiency result = efficiency_of(test::prototype(0.46, 2.0, 25.69)).by_formula;
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
  const EfficiencyResult result = efficiency(*train, {.model = LossModel::kContactRatios});
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
  for (const auto& [model, friction] :
       {std::pair{LossModel::kContactRatios, 0.3}, {LossModel::kPathIntegral, 0.5}}) {
    const EfficiencyResult result =
        efficiency_of(test::prototype(0.0, 0.0, 25.5), {.model = model, .friction = friction});
    EXPECT_TRUE(result.self_locking);
    EXPECT_EQ(result.backward, 0.0);
    EXPECT_GT(result.forward, 0.2);
    EXPECT_LT(result.forward, 0.5);  // the rule of the inclined surface: locks below one half
  }
}

TEST(Efficiency, SpeedsAgreeWithTheKinematicsOfTheTrain) {
  for (const char* output : {"ring2", "ring1"}) {
    GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
    design.topology = train_topology("3k", output);
    auto train = lay_out(design);
    ASSERT_TRUE(train.has_value());
    for (const auto& member : efficiency(*train).forward_drive.members) {
      EXPECT_EQ(member.speed, test::speed_of(*train, member.name)) << member.name;
    }
  }
}

TEST(Efficiency, AnIdleMeshWithInterruptedContactTakesNothingAway) {
  GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
  const auto interrupted = [](GearboxDesign d) {
    d.gears[0].tip_diameter_mm = 12.2;  // the sun hardly reaches its planets
    return efficiency_of(d);
  };
  const EfficiencyResult driven = interrupted(design);
  EXPECT_TRUE(std::isnan(driven.meshes[0].by_path_integral));
  EXPECT_TRUE(std::isnan(driven.forward));
  design.topology = train_topology("3k", "ring2", "carrier");  // the sun idles
  const EfficiencyResult whole = efficiency_of(design), idle = interrupted(design);
  EXPECT_TRUE(std::isnan(idle.meshes[0].by_path_integral));
  EXPECT_GT(idle.forward, 0.0);
  EXPECT_EQ(idle.forward, whole.forward);
  EXPECT_EQ(idle.backward, whole.backward);
  EXPECT_EQ(idle.by_formula.applies, whole.by_formula.applies);
}

TEST(Efficiency, ASingleGearHasNone) {
  const EfficiencyResult result =
      efficiency_of(test::unshifted("gear", "", {20}));
  EXPECT_TRUE(std::isnan(result.forward));
  EXPECT_TRUE(result.meshes.empty());
}

TEST(Efficiency, PathIntegralIsNearTheFormulaForStandardTeeth) {
  const GearboxDesign design = test::unshifted("pair", "wheel", {24, 60});
  const EfficiencyResult formula = efficiency_of(design, {.model = LossModel::kContactRatios});
  const EfficiencyResult exact = efficiency_of(design);
  EXPECT_TRUE(exact.by_formula.applies);
  EXPECT_EQ(exact.by_formula.forward, formula.forward);
  EXPECT_TRUE(formula.meshes[0].formula_applies);
  EXPECT_NEAR(formula.forward, exact.forward, 0.05 * (1 - formula.forward));
  EXPECT_NE(formula.forward, exact.forward);
}

/// Forces on the teeth of two turned gears, with nothing of the library but the ends of the flanks: at every
/// moment the points where the line of action (the common tangent of the base circles) lies between the tips
/// and the ends of the involutes; normal force along it, friction against the sliding of the two surfaces;
/// moments of both about the axes. Work out over work in of a pitch, equal normal forces.
double turned_efficiency(const GearPair& pair, double mu, bool gear1_drives) {
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth, a = pair.centre_distance_mm;
  const double rb1 = base_radius_mm(pair.gear1()), rb2 = base_radius_mm(pair.gear2());
  const Point2 axis2(pair.internal() ? -a : a, 0.0);
  // gear 1 turns at 1 counter-clockwise, gear 2 so that both base circles wind the same line
  const double w1 = 1.0, w2 = (pair.internal() ? 1.0 : -1.0) * z1 / z2;
  const double cosine = (pair.internal() ? rb2 - rb1 : rb1 + rb2) / a;
  const double alpha = std::acos(cosine);
  // the normal of gear 1's base circle where the line leaves it, and the line's direction, along which the
  // contact moves as gear 1 drives; the mate is pushed that way
  const Point2 foot(rb1 * std::cos(alpha), -rb1 * std::sin(alpha));
  const Point2 line(std::sin(alpha), std::cos(alpha));
  const auto inside = [&](const ToothProfile& profile, double r) {
    const double low = std::min(profile.root_form_radius_mm(), profile.tip_form_radius_mm());
    const double high = std::max(profile.root_form_radius_mm(), profile.tip_form_radius_mm());
    return r >= low && r <= high;
  };
  const double pitch = kTwoPi * rb1 / z1;
  const int moments = 20000;
  double mean = 0.0;
  for (int i = 0; i < moments; ++i) {
    double t1 = 0.0, t2 = 0.0;
    for (int k = -1; k < 60; ++k) {
      const Point2 p = foot + line * ((k + (i + 0.5) / moments) * pitch);
      if ((p - foot).dot(line) < 0.0) continue;
      if (!inside(*pair.profile1, p.norm()) || !inside(*pair.profile2, (p - axis2).norm())) continue;
      const auto velocity = [](double w, const Point2& r) { return Point2(-w * r.y(), w * r.x()); };
      const double turning = gear1_drives ? 1.0 : -1.0;  // backward the same teeth run the other way
      Point2 slide = velocity(w1, p) - velocity(w2, p - axis2);
      slide *= turning;
      Point2 on2 = line;  // of unit normal force, on gear 2
      if (slide.norm() > 1e-12) on2 += mu * slide / slide.norm();
      t1 -= p.x() * on2.y() - p.y() * on2.x();
      t2 += (p - axis2).x() * on2.y() - (p - axis2).y() * on2.x();
    }
    mean += (gear1_drives ? t1 / t2 : t2 / t1) / moments;
  }
  const double speeds = gear1_drives ? w2 / w1 : w1 / w2;
  return std::abs(speeds / mean);
}

TEST(Efficiency, PathIntegralIsTheWorkOfTheForcesOnTurnedTeethInBothDirections) {
  for (const auto& [z1, z2, x1, x2, a] :
       {std::tuple{24, 60, 0.0, 0.0, 42.0}, {12, 39, 0.18, 0.0, 25.68}, {39, 90, 0.2, 0.38, 25.68},
        {32, 81, 0.0, 0.7, 25.1}, {20, 21, -0.4, 0.3, 20.4}}) {
    GearboxDesign design = test::unshifted("pair", "wheel", {z1, z2});
    design.centre_distance_mm = a;
    design.gears[0].shift = x1;
    design.gears[1].shift = x2;
    if (a < 0.5 * (z1 + z2) - 4.0) design.gears[1].kind = GearKind::kInternal;
    const auto train = lay_out(design);
    ASSERT_TRUE(train.has_value()) << train.error().front().message;
    const GearPair pair = train->pair(train->meshes[0]);
    for (const double mu : {0.05, 0.15}) {
      const EfficiencyResult result = efficiency(*train, {.friction = mu});
      ASSERT_FALSE(std::isnan(result.forward)) << z1;
      EXPECT_NEAR(result.forward, turned_efficiency(pair, mu, true), 2e-5) << z1;
      EXPECT_NEAR(result.backward, turned_efficiency(pair, mu, false), 2e-5) << z1;
    }
  }
}

TEST(Efficiency, FormulaAppliesOnlyWhereItIsTheFirstOrderOfTheIntegral) {
  // over pairs of all sorts: where it says it applies, the losses agree as friction goes to nothing; and it
  // does not say so of all
  int applies = 0, differ = 0;
  for (int z1 = 9; z1 < 40; z1 += 3)
    for (const double x : {-0.3, 0.0, 0.4})
      for (const bool internal : {false, true}) {
        GearboxDesign design = test::unshifted("pair", "wheel", {z1, 61});
        design.gears[0].shift = design.gears[1].shift = x;
        if (internal) design.gears[1].kind = GearKind::kInternal;
        const auto train = lay_out(design);
        if (!train) continue;
        const EfficiencyResult r = efficiency(*train, {.friction = 1e-6});
        if (std::isnan(r.forward)) continue;
        const double loss = (1.0 - r.by_formula.forward) / (1.0 - r.forward);
        if (r.by_formula.applies) {
          EXPECT_NEAR(loss, 1.0, 1e-4) << z1 << " " << x;
          ++applies;
        } else if (std::abs(loss - 1.0) > 0.01) {
          ++differ;
        }
      }
  EXPECT_GT(applies, 10);
  EXPECT_GT(differ, 10);
}

TEST(Efficiency, InterruptedContactHasNoEfficiencyAndIsNotSelfLocking) {
  GearboxDesign design = test::unshifted("pair", "wheel", {24, 60});
  design.gears[0].tip_diameter_mm = 24.6;
  design.gears[1].tip_diameter_mm = 60.4;
  const EfficiencyResult result = efficiency_of(design);
  EXPECT_TRUE(std::isnan(result.forward));
  EXPECT_TRUE(std::isnan(result.backward));
  EXPECT_FALSE(result.self_locking);
  EXPECT_FALSE(std::isnan(result.by_formula.forward));
}

}  // namespace
}  // namespace trueflank
