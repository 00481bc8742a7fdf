// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the textbook criteria of undercut and interference tell, against the textbooks' formulas,
// and what the real profiles then make of it: their clearances are given here, so that every
// verdict is reached.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/fillet_interference.h"
#include "trueflank/check/involute_interference.h"
#include "trueflank/check/trimming_interference.h"
#include "trueflank/check/trochoid_interference.h"
#include "trueflank/check/undercut.h"

namespace trueflank::test {
namespace {

const double kSin = std::sin(kPi / 9.0), kCos = std::cos(kPi / 9.0);
double inv(double angle) { return std::tan(angle) - angle; }
/// Way along the line of action from the base circle; 20 degrees, module 1.
double roll(double radius, int teeth) {
  return std::sqrt(radius * radius - std::pow(0.5 * teeth * kCos, 2));
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

GearTrain unshifted_pair(int pinion, int wheel, bool internal) {
  GearboxDesign d = pair_design(pinion, wheel, internal);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  return laid_out(d);
}

std::vector<MeshState> state(double centred_mm, double driving_mm,
                             PieceKind piece1 = PieceKind::kInvolute,
                             PieceKind piece2 = PieceKind::kInvolute, double free_share = 0.0) {
  MeshState s;
  s.centred.clearance_mm = centred_mm;
  s.centred.place.piece1 = piece1;
  s.centred.place.piece2 = piece2;
  s.driving.clearance_mm = driving_mm;
  s.removal = RadialRemoval{free_share, free_share == 1.0, free_share > 0.0, {}};
  return {s};
}

TEST(UndercutFigures, AreThoseOfTheRacksStraightFlank) {
  for (const double helix : {0.0, 0.3}) {
    GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
    d.rack = {.dedendum = 1.25, .root_radius = 0.2};
    d.helix_angle_rad = helix;
    d.module_mm = 2.0;
    d.gears = {{.name = "gear", .teeth = 9, .shift = 0.1}};
    const double transverse = std::atan(kSin / kCos / std::cos(helix));
    const double limit =
        1.25 - 0.2 * (1.0 - kSin) - 4.5 / std::cos(helix) * std::pow(std::sin(transverse), 2);
    GearTrain train = laid_out(d);
    Finding f = check_undercut(train)[0];
    const double starts = train.gears[0].profile.root_form_radius_mm();
    EXPECT_EQ(f.status, CheckStatus::kWarn);
    EXPECT_NEAR(f.limit, limit, 1e-12);
    EXPECT_EQ(f.value, 0.1);
    EXPECT_NEAR(f.margin, 0.1 - limit, 1e-12);
    EXPECT_NEAR(told(f.message, "starts at diameter "), 2.0 * starts, 1e-4);
    const double base = 2.0 * 4.5 / std::cos(helix) * std::cos(transverse);
    EXPECT_NEAR(told(f.message, " mm, "), starts - base, 1e-4);
    EXPECT_NEAR(told(f.cure, "at least "), limit, 1e-4);
    EXPECT_GE(told(f.cure, "at least "), limit);
    EXPECT_NEAR(told(f.cure, " ("), limit - 0.1, 1e-4);
    d.gears[0].shift = limit + 0.01;
    f = check_undercut(laid_out(d))[0];
    EXPECT_EQ(f.status, CheckStatus::kPass);
    EXPECT_NEAR(told(f.message, "no undercut down to "), limit, 1e-4);
    EXPECT_FALSE(says(f.message, "protuberance"));
  }
}

TEST(UndercutFigures, AProtuberanceIsTold) {
  GearboxDesign d{.name = "gear", .topology = train_topology("gear")};
  d.rack.protuberance = 0.05;
  d.rack.protuberance_angle_rad = rad_from_deg(8.0);
  d.gears = {{.name = "gear", .teeth = 40, .shift = 0.0}};
  const GearTrain train = laid_out(d);
  const Finding f = check_undercut(train)[0];
  EXPECT_EQ(f.status, CheckStatus::kPass);
  EXPECT_NEAR(told(f.message, "below diameter "),
              2.0 * train.gears[0].profile.root_form_radius_mm(), 1e-4);
}

TEST(UndercutFigures, RingsHaveNone) {
  const Findings of_pair = check_undercut(unshifted_pair(30, 60, true));
  ASSERT_EQ(of_pair.size(), 1U);
  EXPECT_EQ(of_pair[0].where, "pinion");
  GearboxDesign d{.name = "ring", .topology = train_topology("gear")};
  d.gears = {{.name = "gear", .kind = GearKind::kInternal, .teeth = 60, .shift = 0.0}};
  EXPECT_EQ(check_undercut(laid_out(d))[0].status, CheckStatus::kNotApplicable);
}

TEST(InvoluteInterferenceFigures, AreTheRollLengthsAtBothTips) {
  Finding f = check_involute_interference(unshifted_pair(20, 40, false), state(0.05, 0.01))[0];
  const double on_pinion = 30.0 * kSin - roll(21.0, 40), on_wheel = 30.0 * kSin - roll(11.0, 20);
  EXPECT_EQ(f.status, CheckStatus::kPass);
  EXPECT_FALSE(says(f.message, "without load"));
  EXPECT_NEAR(told(f.message, "meets pinion "), on_pinion, 1e-4);
  EXPECT_NEAR(told(f.message, "meets wheel "), on_wheel, 1e-4);
  EXPECT_NEAR(f.value, std::min(on_pinion, on_wheel), 1e-9);
  EXPECT_EQ(f.margin, f.value);
  f = check_involute_interference(unshifted_pair(20, 60, true), state(0.05, 0.01))[0];
  EXPECT_NEAR(f.value, roll(29.0, 60) - 20.0 * kSin, 1e-9);
  EXPECT_FALSE(says(f.message, "meets wheel "));
  EXPECT_EQ(f.status, CheckStatus::kWarn);
}

TEST(InvoluteInterferenceFigures, WhatTheProfilesDoIsTheVerdict) {
  const GearTrain train = unshifted_pair(10, 60, false);
  const double lost = 35.0 * kSin - roll(31.0, 60);
  ASSERT_LT(lost, 0.0);
  Finding f = check_involute_interference(train, state(0.05, 0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NEAR(f.value, lost, 1e-9);
  EXPECT_NEAR(told(f.message, "profiles clear each other by "), 50.0, 1e-6);
  const double ends_at_base_circle = 2.0 * std::hypot(35.0 * kSin, 30.0 * kCos);
  EXPECT_NEAR(told(f.cure, "tip diameter of wheel "), ends_at_base_circle, 2e-3);
  EXPECT_LE(told(f.cure, "tip diameter of wheel "), ends_at_base_circle);
  EXPECT_EQ(check_involute_interference(train, state(-tolerance::kTouch_mm, 0.01))[0].status,
            CheckStatus::kWarn);
  f = check_involute_interference(train, state(-0.02, 0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(told(f.message, "profiles penetrate by "), 20.0, 1e-6);
  f = check_involute_interference(unshifted_pair(60, 10, false), state(0.05, 0.01))[0];
  EXPECT_NEAR(f.value, lost, 1e-9);
  EXPECT_NEAR(told(f.cure, "tip diameter of pinion "), ends_at_base_circle, 2e-3);
}

TEST(InvoluteInterferenceFigures, ReliefsKeepContactOnTheInvoluteWhileTheProfilesDo) {
  GearboxDesign d = pair_design(10, 60, false);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "wheel").modifications = {
      .tip_relief_um = 30.0,
      .tip_relief_start_diameter_mm = 2.0 * std::hypot(30.0 * kCos, 35.0 * kSin - 0.3)};
  const GearTrain train = laid_out(d);
  Finding f = check_involute_interference(train, state(0.05, 0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kPass);
  EXPECT_NEAR(f.value, 0.3, 1e-3);
  EXPECT_NEAR(told(f.message, "touch without load from "), f.value, 1e-4);
  EXPECT_EQ(check_involute_interference(train, state(0.05, -tolerance::kTouch_mm))[0].status,
            CheckStatus::kPass);
  f = check_involute_interference(train, state(0.05, -0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NEAR(f.value, 35.0 * kSin - roll(31.0, 60), 1e-9);  // then the whole flank counts
  EXPECT_EQ(check_involute_interference(train, state(-0.02, 0.01))[0].status, CheckStatus::kFail);
}

TEST(FilletInterferenceFigures, AreRadiiAboveTheRootFormCircles) {
  for (const bool internal : {false, true}) {
    const GearTrain train = unshifted_pair(24, 60, internal);
    const Finding f = check_fillet_interference(train, state(0.05, 0.01))[0];
    const double start1 = internal ? roll(29.0, 60) - 18.0 * kSin : 42.0 * kSin - roll(31.0, 60);
    const double start2 = internal ? roll(13.0, 24) + 18.0 * kSin : 42.0 * kSin - roll(13.0, 24);
    ASSERT_GT(start1, 0.0);
    const double gap1 =
        std::hypot(12.0 * kCos, start1) - train.gears[0].profile.root_form_radius_mm();
    double gap2 = std::hypot(30.0 * kCos, start2) - train.gears[1].profile.root_form_radius_mm();
    if (internal) gap2 = -gap2;
    EXPECT_FALSE(says(f.message, "without load"));
    EXPECT_NEAR(told(f.message, "form circle by "), gap1, 1e-4);
    EXPECT_NEAR(told(f.message, " on pinion, "), gap2, 1e-4);
    EXPECT_NEAR(f.value, std::min(gap1, gap2), 1e-9);
    EXPECT_EQ(f.margin, f.value);
    EXPECT_EQ(f.status, gap1 > 0.0 && gap2 > 0.0 ? CheckStatus::kPass : CheckStatus::kWarn);
  }
}

TEST(FilletInterferenceFigures, WhatTheProfilesDoAtTheirRootsIsTheVerdict) {
  const GearTrain good = unshifted_pair(24, 60, false), bad = unshifted_pair(10, 60, false);
  const auto judged = [](const GearTrain& train, const std::vector<MeshState>& s) {
    return check_fillet_interference(train, s)[0];
  };
  EXPECT_EQ(judged(good, state(-0.02, -0.02)).status,
            CheckStatus::kPass);  // elsewhere: overlap tells
  for (const auto& [piece1, piece2] : {std::pair(PieceKind::kFillet, PieceKind::kInvolute),
                                       std::pair(PieceKind::kInvolute, PieceKind::kRoot)}) {
    const Finding f = judged(good, state(-0.02, -0.02, piece1, piece2));
    EXPECT_EQ(f.status, CheckStatus::kFail);
    EXPECT_NEAR(told(f.message, "the criterion holds, but the exact profiles penetrate by "), 20.0,
                1e-6);
    EXPECT_EQ(judged(good, state(-tolerance::kTouch_mm, 0.0, piece1, piece2)).status,
              CheckStatus::kPass);
  }
  const Finding fails = judged(bad, state(-0.02, -0.02, PieceKind::kFillet));
  EXPECT_EQ(fails.status, CheckStatus::kFail);
  EXPECT_FALSE(says(fails.message, "the criterion holds"));
  EXPECT_LT(fails.value, 35.0 * kSin - roll(31.0, 60) +
                             1e-9);  // at least as far as contact would start too early
  const Finding lost = judged(bad, state(0.05, 0.01));
  EXPECT_EQ(lost.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(lost.message, "contact is lost there but nothing jams"));
  EXPECT_FALSE(says(lost.message, "driving, the"));
  EXPECT_TRUE(says(lost.cure, "tip diameter of wheel "));
  EXPECT_TRUE(says(judged(unshifted_pair(60, 10, false), state(0.05, 0.01)).cure,
                   "tip diameter of pinion "));
  EXPECT_NEAR(told(judged(bad, state(0.05, -0.01)).message, " meet "), 10.0, 1e-6);
  EXPECT_TRUE(says(judged(bad, state(0.0, -0.01)).message, "driving, the"));
  EXPECT_FALSE(says(judged(bad, state(0.05, -tolerance::kTouch_mm)).message, "driving, the"));
  EXPECT_TRUE(says(judged(bad, state(-0.02, -0.02)).message, "not worst at a root"));
}

TEST(FilletInterferenceFigures, ReliefsKeepContactOffTheRootsUntilALoadTakesThemUp) {
  for (const bool pinion_first : {true, false}) {
    GearboxDesign d = pinion_first ? pair_design(10, 60, false) : pair_design(60, 10, false);
    d.gears[0].shift = d.gears[1].shift = 0.0;
    const GearTrain plain = laid_out(d);
    gear(d, pinion_first ? "wheel" : "pinion").modifications = {
        .tip_relief_um = 30.0,
        .tip_relief_start_diameter_mm = 2.0 * std::hypot(30.0 * kCos, 35.0 * kSin - 1.5)};
    const GearTrain train = laid_out(d);
    const Finding f = check_fillet_interference(train, state(0.05, -tolerance::kTouch_mm))[0];
    ASSERT_GE(f.value, 0.0);
    EXPECT_EQ(f.status, CheckStatus::kPass);
    EXPECT_TRUE(says(f.message, "under a load that takes up the reliefs")) << f.message;
    const Finding whole = check_fillet_interference(plain, state(0.05, 0.01))[0];
    EXPECT_NEAR(told(f.message, "(to their tips: "), told(whole.message, "form circle by "), 1e-4);
    EXPECT_EQ(check_fillet_interference(train, state(-tolerance::kTouch_mm, 0.01))[0].status,
              CheckStatus::kPass);
    for (const auto& s : {state(0.05, -0.01), state(-0.02, 0.01)})  // turned, they do not pass
      EXPECT_EQ(check_fillet_interference(train, s)[0].status, CheckStatus::kWarn);
  }
}

/// KHK's criteria of internal gears, as angles of the ring [deg].
struct Khk {
  double trochoid_deg = 0.0, trimming_deg = 0.0;
  Khk(int z1, int z2) {
    const double r1 = 0.5 * z1 + 1.0, r2 = 0.5 * z2 - 1.0, a = 0.5 * (z2 - z1),
                 s = static_cast<double>(z1) / z2;
    const double tip1 = std::acos(0.5 * z1 * kCos / r1), tip2 = std::acos(0.5 * z2 * kCos / r2);
    const auto margin = [&](double theta1, double theta2) {
      return (s * (theta1 + inv(tip1) - inv(kPi / 9.0)) - (theta2 + inv(tip2) - inv(kPi / 9.0))) *
             180.0 / kPi;
    };
    trochoid_deg = margin(std::acos((r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1)),
                          std::acos((a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2)));
    const double ratio = std::cos(tip1) / std::cos(tip2);
    trimming_deg =
        margin(std::asin(std::sqrt((1.0 - ratio * ratio) / (1.0 - s * s))),
               std::asin(std::sqrt((1.0 / (ratio * ratio) - 1.0) / (1.0 / (s * s) - 1.0))));
  }
};

TEST(TrochoidInterferenceFigures, AreTheTextbooks) {
  for (const auto& [z1, z2] : {std::pair(30, 60), std::pair(40, 52), std::pair(40, 45)}) {
    const double margin = Khk(z1, z2).trochoid_deg;
    const Finding f =
        check_trochoid_interference(unshifted_pair(z1, z2, true), state(0.05, 0.01))[0];
    EXPECT_NEAR(f.value, margin, 1e-9) << z1 << " " << z2;
    EXPECT_EQ(f.margin, f.value);
    EXPECT_EQ(f.status, margin >= 0.0 ? CheckStatus::kPass : CheckStatus::kWarn);
    EXPECT_NEAR(told(f.message, margin >= 0.0 ? "passes the tip of wheel by "
                                              : "runs into the tip of wheel by "),
                std::abs(margin), 1e-3);
  }
  EXPECT_EQ(check_trochoid_interference(unshifted_pair(30, 60, false), state(0.05, 0.01))[0].status,
            CheckStatus::kNotApplicable);
}

TEST(TrochoidInterferenceFigures, APinionAroundTheRingsTipsHasNoCriterion) {
  const Finding f = check_trochoid_interference(unshifted_pair(58, 60, true), state(0.05, 0.01))[0];
  EXPECT_TRUE(says(f.message, "the tip circle of pinion lies all around that of wheel"))
      << f.message;
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_TRUE(std::isnan(f.value));
}

TEST(TrochoidInterferenceFigures, WhatTheProfilesDoIsTheVerdict) {
  const GearTrain train = unshifted_pair(40, 45, true);
  ASSERT_LT(Khk(40, 45).trochoid_deg, 0.0);
  Finding f = check_trochoid_interference(train, state(0.05, 0.01))[0];
  EXPECT_NEAR(told(f.message, "profiles clear each other by "), 50.0, 1e-6);
  EXPECT_FALSE(f.cure.empty());
  EXPECT_EQ(check_trochoid_interference(train, state(-tolerance::kTouch_mm, 0.01))[0].status,
            CheckStatus::kWarn);
  f = check_trochoid_interference(train, state(-0.02, 0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kFail);
  EXPECT_NEAR(told(f.message, "profiles penetrate by "), 20.0, 1e-6);
  EXPECT_EQ(
      check_trochoid_interference(unshifted_pair(30, 60, true), state(-0.02, -0.02))[0].status,
      CheckStatus::kPass);
}

TEST(TrimmingInterferenceFigures, AreTheTextbooksAndTheRotationsAtWhichThePinionLeaves) {
  for (const auto& [z1, z2] : {std::pair(24, 60), std::pair(36, 60), std::pair(44, 60)}) {
    const double margin = Khk(z1, z2).trimming_deg;
    const GearTrain train = unshifted_pair(z1, z2, true);
    const auto judged = [&, t = &train](double free_share, double centred_mm = 0.05) {
      return check_trimming_interference(
          *t, state(centred_mm, 0.01, PieceKind::kInvolute, PieceKind::kInvolute, free_share))[0];
    };
    Finding f = judged(1.0);
    EXPECT_NEAR(f.value, margin, 1e-9) << z1 << " " << z2;
    EXPECT_EQ(f.margin, f.value);
    EXPECT_EQ(f.status, CheckStatus::kPass);
    EXPECT_TRUE(says(f.message, "radially at every rotation"));
    EXPECT_NEAR(told(f.message, "textbook criterion "), margin, 1e-3);
    f = judged(0.25);
    EXPECT_EQ(f.status, CheckStatus::kWarn);
    EXPECT_NEAR(told(f.message, "radially at "), 25.0, 1e-9);
    EXPECT_TRUE(says(f.message, "It goes in axially."));
    EXPECT_EQ(says(f.cure, "more teeth between pinion and ring"), margin >= 0.0) << margin;
    EXPECT_TRUE(says(judged(0.0).message, "radially at no rotation"));
    EXPECT_TRUE(says(judged(0.0, -0.02).message, "Axially it does not go in either"));
    EXPECT_TRUE(says(judged(0.0, -tolerance::kTouch_mm).message, "It goes in axially."));
  }
  EXPECT_EQ(check_trimming_interference(unshifted_pair(30, 60, false), state(0.05, 0.01))[0].status,
            CheckStatus::kNotApplicable);
}

/// A pair of which one flank's helix is off, and a tip of the pinion.
GearTrain with_slope(int pinion, int wheel, double slope_um,
                     std::optional<double> tip_diameter_mm = {}) {
  GearboxDesign d = pair_design(pinion, wheel, true);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  gear(d, "pinion").modifications.helix_slope_um = slope_um;
  gear(d, "pinion").tip_diameter_mm = tip_diameter_mm;
  return laid_out(d);
}

/// The tip that a cure names is where the margin is used up, what the modifications take of it
/// included.
void expect_cure_counts_modifications(Finding (*judged)(const GearTrain&), int pinion, int wheel) {
  const double cost =
      judged(with_slope(pinion, wheel, 0.0)).value - judged(with_slope(pinion, wheel, 30.0)).value;
  ASSERT_GT(cost, 0.02);
  const Finding f = judged(with_slope(pinion, wheel, 30.0));
  ASSERT_LT(f.value, 0.0);
  const double tip = told(f.cure, "tip diameter of pinion ");
  ASSERT_GT(tip, pinion) << f.cure;
  EXPECT_NEAR(judged(with_slope(pinion, wheel, 30.0, tip)).value, 0.0, 0.2 * cost) << f.cure;
}

TEST(TrochoidInterferenceFigures, TheCureCountsModifications) {
  expect_cure_counts_modifications(
      [](const GearTrain& t) { return check_trochoid_interference(t, state(0.05, 0.01))[0]; }, 40,
      48);
}

TEST(TrimmingInterferenceFigures, TheCureCountsModifications) {
  expect_cure_counts_modifications(
      [](const GearTrain& t) { return check_trimming_interference(t, state(0.05, 0.01))[0]; }, 44,
      60);
}

TEST(TrimmingInterferenceFigures, APinionLargerThanTheRingsTipsHasNoCriterion) {
  const GearTrain train = unshifted_pair(58, 60, true);
  const Finding f = check_trimming_interference(train, state(0.05, 0.01))[0];
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NEAR(told(f.message, "exceeds that of wheel by "), 1.0, 1e-9);
  EXPECT_NEAR(f.value, -1.0, 1e-9);
  EXPECT_EQ(f.margin, f.value);
  EXPECT_EQ(f.unit, "mm");
}

TEST(TrimmingInterferenceFigures, AHerringboneGoesInOnlyIfItsRingIsSplit) {
  GearboxDesign d = pair_design(44, 60, true);
  gear(d, "pinion").shift = gear(d, "wheel").shift = 0.0;
  d.helix_angle_rad = 0.3;
  d.herringbone = true;
  EXPECT_TRUE(says(check_trimming_interference(laid_out(d), state(0.05, 0.01))[0].message,
                   "the ring must be split"));
  gear(d, "wheel").halves = true;
  EXPECT_TRUE(says(check_trimming_interference(laid_out(d), state(0.05, 0.01))[0].message,
                   "each half of the ring goes on from its side"));
}

}  // namespace
}  // namespace trueflank::test
