// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the teeth could not be made as asked for, with its figures.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/check/profile.h"

namespace trueflank::test {
namespace {

const double kSinAlpha = std::sin(kPi / 9.0), kCosAlpha = std::cos(kPi / 9.0);

GearboxDesign gear_design(int teeth, double shift, GearKind kind = GearKind::kExternal) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .kind = kind, .teeth = teeth, .shift = shift}};
  return d;
}

Finding judged(const GearboxDesign& d) { return check_profile(laid_out(d))[0]; }

TEST(ProfileFigures, ATipDiameterAsToldIsNoLongerPointed) {
  GearboxDesign d = gear_design(8, 1.0);
  const Finding f = judged(d);
  EXPECT_EQ(f.value, 1.0);
  EXPECT_EQ(f.margin, -1.0);
  EXPECT_NEAR(told(f.message, "instead of "), 12.0, 1e-6);
  const double ends = told(f.message, "end at diameter ");
  EXPECT_NEAR(told(f.cure, "tip diameter of at most "), ends, 2e-4);
  d.gears[0].tip_diameter_mm = told(f.cure, "tip diameter of at most ");
  EXPECT_EQ(judged(d).status, CheckStatus::kPass);
  d.gears[0].tip_diameter_mm = ends + 2e-3;
  EXPECT_EQ(judged(d).status, CheckStatus::kWarn);
}

TEST(ProfileFigures, ARootRoundingIsAtMostTheFullRoundOfTheRack) {
  GearboxDesign d = gear_design(30, 0.0);
  d.rack.root_radius = 0.6;
  // the circle that touches both flanks and the bottom of the rack's tip
  const double full = (kPi / 4.0 - 1.25 * kSinAlpha / kCosAlpha) * kCosAlpha / (1.0 - kSinAlpha);
  const Finding f = judged(d);
  EXPECT_NEAR(told(f.message, "full round, "), full, 1e-4);
  EXPECT_NEAR(told(f.cure, "rack.root_radius of at most "), full, 1e-4);
  EXPECT_LE(told(f.cure, "rack.root_radius of at most "), full);
  d.rack.root_radius = told(f.cure, "rack.root_radius of at most ");
  EXPECT_EQ(judged(d).status, CheckStatus::kPass);
}

TEST(ProfileFigures, ARingsTipInsideItsBaseCircleIsTold) {
  const Finding f = judged(gear_design(24, 0.0, GearKind::kInternal));
  EXPECT_NEAR(told(f.message, "tip circle of diameter "), 22.0, 1e-6) << f.message;
  EXPECT_NEAR(told(f.message, "inside the base circle of "), 24.0 * kCosAlpha, 1e-4);
  EXPECT_NEAR(told(f.cure, "tip diameter of at least "), 24.0 * kCosAlpha, 1e-4);
  EXPECT_GE(told(f.cure, "tip diameter of at least "), 24.0 * kCosAlpha);
}

TEST(ProfileFigures, OfAShapedRingTheCutterIsToldAndWhatItTrims) {
  GearboxDesign d = gear_design(60, 0.0, GearKind::kInternal);
  d.gears[0].root = RingRoot::kShaper;
  d.gears[0].cutter = ShaperCutter{.teeth = 52, .shift = 0.0, .tip_radius = 0.0};
  const GearTrain train = laid_out(d);
  ASSERT_TRUE(train.gears[0].profile.notes().tip_trimmed);
  const Finding f = check_profile(train)[0];
  const double ends = 2.0 * train.gears[0].profile.tip_form_radius_mm();
  EXPECT_GT(ends, 2.0 * train.gears[0].profile.tip_radius_mm());
  EXPECT_NEAR(told(f.message, "the involute ends at diameter "), ends, 1e-4);
  EXPECT_NEAR(told(f.cure, "tip diameter of at least "), ends, 2e-4);
  EXPECT_GE(told(f.cure, "tip diameter of at least "), ends - 1e-9);
  d.gears[0].cutter = ShaperCutter{.teeth = 32, .shift = 0.0, .tip_radius = 0.6};
  const Finding full = judged(d);
  d.gears[0].cutter->tip_radius = told(full.cure, "cutter.tip_radius of at most ");
  EXPECT_EQ(judged(d).status, CheckStatus::kPass) << full.cure;
  d.gears[0].cutter->tip_radius += 2e-4;
  EXPECT_EQ(judged(d).status, CheckStatus::kWarn);
  d.gears[0].root = RingRoot::kFillet;
  d.gears[0].cutter = std::nullopt;
  d.rack.root_radius = 0.9;
  const Finding fillet = judged(d);
  EXPECT_NE(fillet.cure.find("rack.root_radius of at most"), std::string::npos) << fillet.message;
}

}  // namespace
}  // namespace trueflank::test
