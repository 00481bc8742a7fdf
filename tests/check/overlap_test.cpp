// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/check/check_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/gear_distance.h"
#include "trueflank/check/clearance/scalar_minimum.h"
#include "trueflank/check/ring_criteria.h"

namespace trueflank::test {
namespace {

MeshClearance clearance_of(const GearboxDesign& design, std::size_t mesh = 0) {
  const GearTrain train = laid_out(design);
  return mesh_clearance(train.pair(train.meshes[mesh]));
}

/// Where a function is lowest in [0, 1], to 1e-6, and how often it was asked for that.
template <class Function>
std::pair<ScalarMinimum, int> searched(const Function& f) {
  int asked = 0;
  const auto counted = [&](double x) { return ++asked, f(x); };
  const ScalarMinimum found = find_minimum(counted, 0.0, 1.0, 1e-6);
  return {found, asked};
}

TEST(ScalarMinimum, OfARisingFunctionIsItsFirstEndAfterATenthOfTheRange) {
  for (const double sign : {1.0, -1.0}) {
    const auto [found, asked] = searched([&](double x) { return std::exp(sign * x); });
    EXPECT_EQ(found.at, sign > 0.0 ? 0.0 : 1.0);
    EXPECT_EQ(found.value, sign > 0.0 ? 1.0 : std::exp(-1.0));
    EXPECT_LE(asked, 12);  // 33 by golden section alone
  }
}

TEST(ScalarMinimum, BesideAnEndIsNotTakenForTheEnd) {
  for (const double at : {1e-5, 0.02, 0.3, 0.98, 1.0 - 1e-5}) {
    const auto [found, asked] = searched([&](double x) { return (x - at) * (x - at) * (1.0 + x); });
    EXPECT_NEAR(found.at, at, 3e-6) << at;
  }
}

TEST(ScalarMinimum, SearchIsEndedWhereItsCallerKnowsEnough) {
  const auto cone = [](double x) { return 1.0 + std::abs(x - 0.6); };  // changes by no more than x does
  int asked = 0;
  const auto counted = [&](double x) { return ++asked, cone(x); };
  const auto above = [](double limit) {
    return [=](double value, double low, double high, double reach) {
      return value - reach > limit && low > limit && high > limit;
    };
  };
  const ScalarMinimum ended = find_minimum(counted, 0.0, 1.0, 1e-6, above(0.8), cone);
  EXPECT_GT(ended.value, 0.8);
  EXPECT_LE(asked, 8);
  EXPECT_NEAR(find_minimum(cone, 0.0, 1.0, 1e-6, above(1.5), cone).at, 0.6, 2e-6);  // it may yet come below
}

TEST(GearDistance, IsZeroOnTheProfileAndHasTheSignOfTheSide) {
  GearboxDesign d = pair_design(9, 60, true);
  gear(d, "pinion").shift = 0.0;  // undercut
  gear(d, "wheel").root = RingRoot::kShaper;
  gear(d, "wheel").cutter = ShaperCutter{25, 0.0, 0.2};
  const GearTrain train = laid_out(d);
  for (const TrainGear& g : train.gears) {
    const GearDistance distance(g.profile);
    const double outside = g.profile.gear().kind == GearKind::kExternal ? -1.0 : 1.0;
    for (const ProfilePiece& piece : g.profile.pieces()) {
      for (int i = 1; i < 40; ++i) {
        const double u = piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / 40.0;
        const double turn = kTwoPi * (i % g.profile.gear().teeth) / g.profile.gear().teeth;
        const Point2 p = point_at(piece.curve, u);
        const Point2 n = outside * perpendicular(tangent_at(piece.curve, u));
        EXPECT_NEAR(distance.nearest(rotated(p, turn)).distance_mm, 0.0, 2e-9);
        EXPECT_NEAR(distance.nearest(rotated(p + 0.01 * n, turn)).distance_mm, 0.01, 2e-9);
        EXPECT_NEAR(distance.nearest(mirrored(p - 0.01 * n)).distance_mm, -0.01, 2e-9);
      }
    }
  }
}

TEST(MeshClearance, OfConjugateFlanksIsHalfTheNormalBacklash) {
  GearboxDesign d = pair_design(25, 40, false, 0.1);
  const GearTrain train = laid_out(d);
  const GearPair pair = train.pair(train.meshes[0]);
  EXPECT_NEAR(mesh_clearance(pair).clearance_mm, 0.05 * std::cos(working_pressure_angle_rad(pair)),
              1e-9);
  d.backlash_mm = 0.0;
  EXPECT_EQ(clearance_of(d).clearance_mm, 0.0);
}

TEST(MeshClearance, TakesTheRootWhereThatIsCloser) {
  GearboxDesign d = pair_design(25, 40, false, 0.3);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "pinion").tip_diameter_mm = 27.0 + 2.0 * 0.24;  // 0.01 mm from the wheel's root circle
  EXPECT_NEAR(clearance_of(d).clearance_mm, 0.01, 1e-9);
  gear(d, "pinion").tip_diameter_mm = 27.0 + 2.0 * 0.26;
  const MeshClearance deep = clearance_of(d);
  EXPECT_NEAR(deep.clearance_mm, -0.01, 1e-9);
  EXPECT_EQ(deep.exact, ExactVerdict::kCross);
}

TEST(MeshClearance, OverlapOfTheFlanksIsHalfTheNegativeNormalBacklash) {
  GearboxDesign d = pair_design(25, 40, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "pinion").thinning_mm = -0.02;
  gear(d, "wheel").thinning_mm = 0.0;
  const MeshClearance c = clearance_of(d);
  EXPECT_NEAR(c.clearance_mm, -0.01 * std::cos(kPi / 9.0), 1e-6);
  EXPECT_EQ(c.exact, ExactVerdict::kCross);
}

TEST(MeshClearance, APhaseErrorTakesUpTheBacklash) {
  const GearTrain train = laid_out(pair_design(25, 40, false, 0.1));
  const GearPair pair = train.pair(train.meshes[0]);
  const double half = 0.05 / pitch_radius2_mm(pair);
  EXPECT_NEAR(mesh_clearance(pair, half).clearance_mm, 0.0, 1e-9);
  EXPECT_LT(mesh_clearance(pair, 1.2 * half).clearance_mm, -0.005);
  EXPECT_LT(mesh_clearance(pair, -1.2 * half).clearance_mm, -0.005);
}

TEST(Overlap, OfThePrototypePassesWithBacklashAndCutsATenthOfAMicrometreWithoutIt) {
  const GearTrain loose = laid_out(paper_design(0.05));
  for (const Finding& f : check_overlap(loose, mesh_states(loose)))
    EXPECT_EQ(f.status, CheckStatus::kPass) << f.message;
  const GearTrain tight = laid_out(paper_design(0.0));
  const Findings findings = check_overlap(tight, mesh_states(tight));
  EXPECT_EQ(only(findings, "overlap", "sun-planet1").status, CheckStatus::kPass);
  EXPECT_EQ(only(findings, "overlap", "planet2-ring2").status, CheckStatus::kPass);
  const Finding& ring1 = only(findings, "overlap", "planet1-ring1");
  EXPECT_EQ(ring1.status, CheckStatus::kFail);
  EXPECT_NEAR(ring1.value, -0.155, 0.001);
}

TEST(Overlap, TheCureClearsIt) {
  GearboxDesign d = simple_design(12, 30, 72, 3);
  const GearTrain train = laid_out(d);
  const Finding f = only(check_overlap(train, mesh_states(train)), "overlap", "planet-ring");
  ASSERT_EQ(f.status, CheckStatus::kFail);
  const std::string number = "tip diameter of ring ";
  ASSERT_TRUE(f.cure.starts_with(number)) << f.cure;
  gear(d, "ring").tip_diameter_mm = std::stod(f.cure.substr(number.size())) + 1e-4;
  const GearTrain cured = laid_out(d);
  EXPECT_EQ(only(check_overlap(cured, mesh_states(cured)), "overlap", "planet-ring").status,
            CheckStatus::kPass);
}

TEST(RadialRemoval, WorksForFewPinionTeethAndNotForNearlyEqualCounts) {
  for (double backlash : {0.0, 0.1}) {
    const GearTrain far = laid_out(pair_design(20, 60, true, backlash));
    const GearPair easy = far.pair(far.meshes[0]);
    EXPECT_TRUE(radial_removal(easy).at_every_rotation);
    EXPECT_GT(trimming_margin_rad(easy), 0.0);
    const GearTrain near = laid_out(pair_design(20, 30, true, backlash));
    const GearPair hard = near.pair(near.meshes[0]);
    EXPECT_FALSE(radial_removal(hard).at_every_rotation);
    EXPECT_LT(trimming_margin_rad(hard), 0.0);
  }
}

TEST(Trochoid, NineTeethOfDifferenceAreEnoughForStandardTeeth) {
  // KHK: avoided for standard teeth of 20 degrees where the difference exceeds 9
  const auto margin = [](int pinion, int ring) {
    GearboxDesign d = pair_design(pinion, ring, true);
    gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
    const GearTrain train = laid_out(d);
    return trochoid_margin_rad(train.pair(train.meshes[0]));
  };
  EXPECT_GT(margin(40, 50), 0.0);
  EXPECT_LT(margin(40, 47), 0.0);
}

TEST(Trochoid, IsTheTextbooksFormulaWithoutBacklash) {
  const GearTrain train = laid_out(pair_design(30, 42, true));
  const GearPair pair = train.pair(train.meshes[0]);
  const double a = pair.centre_distance_mm, r1 = pair.profile1->tip_radius_mm(),
               r2 = pair.profile2->tip_radius_mm();
  const auto inv = [](double angle) { return std::tan(angle) - angle; };
  const double a1 = std::acos(base_radius_mm(pair.gear1()) / r1);
  const double a2 = std::acos(std::min(1.0, base_radius_mm(pair.gear2()) / r2));
  const double aw = working_pressure_angle_rad(pair);
  const double theta1 = std::acos((r2 * r2 - r1 * r1 - a * a) / (2 * a * r1)) + inv(a1) - inv(aw);
  const double theta2 = std::acos((a * a + r2 * r2 - r1 * r1) / (2 * a * r2));
  EXPECT_NEAR(trochoid_margin_rad(pair), theta1 * 30.0 / 42.0 + inv(aw) - inv(a2) - theta2, 1e-12);
}

}  // namespace
}  // namespace trueflank::test
