// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"

// Names of the whole gear beside forms of a few teeth, of a part of them, or of all: an
// eccentricity beside bent corners, a scale beside a hollow, a relief beside teeth that stand
// aside, a taper beside a wobble.
namespace trueflank::test {
namespace {

constexpr double kTwoPi = 2.0 * M_PI;

/// Tip corners at one end (-1, 1) of three teeth, bent to one side: a part that was dropped.
Process dropped(int first, double um, double end) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    if (s.tooth < first || s.tooth > first + 2) return 0.0;
    const double tip = std::max(0.0, 0.5 * (s.u + 1.0) - 0.4) / 0.6;
    return -um * tip * std::max(0.0, end * s.v) * s.side;
  });
}

TEST(NamesOfWholeGears, AnEccentricityBesideTeethThatWereDropped) {
  const MadeGear gear = spur(22);
  const auto result = close(
      gear, scan_of(gear, {off_centre(4.0, 0.0), dropped(3, 18.0, -1.0)}, scanned(12000, 1.0, 5)),
      true);
  const auto* found = find(result, "eccentricity");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_NEAR(parameter(*found, "amplitude_um").value, 4.0, 0.2) << list(result);
}

TEST(NamesOfWholeGears, AScaleBesideAHollowFromEndToEnd) {
  constexpr double kPercent = -0.27;
  const MadeGear gear = spur(41);
  const auto hollow = [](auto&, const FlankSpot& s, auto&) {
    return -14.0 * (1.0 - s.v * s.v) * (1.0 + 0.6 * s.v);
  };
  auto scan = scan_of(gear, {scaled(kPercent), grown(hollow)}, scanned(9000, 2.0, 3));
  add_tips(gear, kPercent, scan);
  const auto result = close(gear, scan, true);
  expect_size(result, "scale", "percent", kPercent, 0.01);
  EXPECT_TRUE(tells(result, "a hollow over the face from end to end, most at a height of 6"))
      << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
}

TEST(NamesOfWholeGears, ReliefsBesideTeethThatStandAside) {
  for (const double deg : survey_of(1, {46.0, 252.0})) {
    const MadeGear gear = deg < 90.0 ? helical(22, 9.0) : spur(22);
    Process both = grown([](auto&, const FlankSpot& s, auto&) {
      const double off = std::max(0.0, s.u + 0.1) / 1.1;
      return -11.6 * off * off;
    });
    both.move_um = [&](const MadeGear& g, const FlankSpot& s, const Vec3& p) -> Vec3 {
      const bool aside = s.tooth > 10 && s.tooth < 19;
      return aside ? off_centre(36.0, deg).move_um(g, s, p) : Vec3{0.0, 0.0, 0.0};
    };
    const auto result = close(gear, scan_of(gear, {both}, scanned(9000, 1.8, 4)), true);
    expect_size(result, "tip_relief", "amount_um", 11.6, 0.6);
    EXPECT_TRUE(tells(result, "8 teeth from tooth 11 on stand aside")) << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(NamesOfWholeGears, ATaperBesideAThicknessThatWobbles) {
  const MadeGear gear = spur(38);
  InspectionOptions options;
  options.profile = options.index = false;
  options.noise_um = 0.5;
  options.seed = 8;
  const auto wobble = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const double at = kTwoPi * (s.tooth - 1) / g.teeth;
    return -2.1 * s.v + 4.1 * s.v * (std::cos(2.0 * at - 0.9) + 0.5 * std::cos(3.0 * at + 0.9));
  };
  const auto result = close(gear, inspection_of(gear, {grown(wobble)}, options));
  expect_size(result, "taper", "slope_um", -4.2, 0.2);
}

// Nicks on a few teeth made the choice forget that the gear is out of round.
TEST(NamesOfWholeGears, LobesBesideNicksAtTheTips) {
  const MadeGear gear = helical(21, 13.0);
  struct Nick {
    int tooth, side;
    double v;
  };
  const auto nicked = [](auto&, const FlankSpot& s, auto&) {
    double um = 0.0;
    for (const Nick& nick :
         {Nick{15, 1, 0.4}, {5, -1, -0.56}, {9, -1, 0.28}, {13, -1, -0.76}, {3, 1, 0.28}})
      if (s.tooth == nick.tooth && s.side == nick.side)
        um +=
            47.0 * std::exp(-std::pow((s.u - 0.9) / 0.25, 2) - std::pow((s.v - nick.v) / 0.22, 2));
    return um;
  };
  const auto result = close(
      gear, scan_of(gear, {out_of_round(3, 22.9, -44.3), grown(nicked)}, scanned(13000, 2.0, 1)),
      true);
  expect_size(result, "lobing", "amplitude_um", 22.9, 0.8);
}

// A little that may be left does not keep an answer that leaves several times more.
TEST(NamesOfWholeGears, LeansOverTheFaceAreNoLobingOfThirtyTimesTheirSize) {
  // Helix traces of a helical gear: it was out of round by more than a tenth of a millimetre.
  const MadeGear gear = helical(60, 20.0);
  const auto saddle = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    return 4.0 * s.v * std::cos(2.0 * kTwoPi * (s.tooth - 1) / g.teeth - 0.6);
  });
  InspectionOptions options{.teeth = {1, 9, 16, 24, 31, 39, 46, 54},
                            .noise_um = 0.8,
                            .profile = false,
                            .index = false,
                            .seed = 3};
  const auto result = close(gear, inspection_of(gear, {saddle}, options));
  EXPECT_EQ(find(result, "lobing"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "twice per turn, sloping over the face")) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

TEST(NamesOfWholeGears, AScaleAndALeadBesideDirtOnOneSide) {
  constexpr double kPercent = -0.54, kTowards = 4.38;
  const MadeGear gear = spur(19);
  const auto dirt = [=](const MadeGear& g, const FlankSpot& s, const Vec3&) {
    const Vec3 n = normal_at(g, s);
    const double facing = n[0] * std::cos(kTowards) + n[1] * std::sin(kTowards);
    return (facing > 0.0 ? 24.7 * facing * facing : 0.0) - 10.4 * s.v * s.side;
  };
  const auto result =
      close(gear, scan_of(gear, {scaled(kPercent), grown(dirt)}, scanned(11000, 2.5, 10)), true);
  expect_size(result, "scale", "percent", kPercent, 0.01);
  expect_size(result, "helix_error", "slope_um", -20.8, 0.6);
  EXPECT_TRUE(tells(result, "flanks that face towards 251 deg stand out")) << list(result);
}

}  // namespace
}  // namespace trueflank::test
