// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"

// Forms that names together follow, or that are the mean of something: no name is told for them.
namespace trueflank::test {
namespace {

InspectionOptions four_teeth(unsigned seed) {
  InspectionOptions options;
  options.teeth = {1, 7, 13, 19};
  options.points = 60;
  options.noise_um = 0.7;
  options.seed = seed;
  return options;
}

TEST(OneForm, WhatIsThickerTowardsAnEndIsNoSlopeWithABow) {
  const MadeGear gear = spur(24);
  const auto plated = [](auto&, const FlankSpot& s, auto&) {
    return 5.0 * std::exp((s.u - 1.0) / 0.4);
  };
  const auto swollen = [](auto&, const FlankSpot& s, auto&) {
    return 7.0 * std::pow(0.5 * (1.0 - s.u), 4);
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto tip = close(gear, inspection_of(gear, {grown(plated)}, four_teeth(seed)));
    EXPECT_FALSE(has_name(tip)) << list(tip);
    const auto root = close(gear, inspection_of(gear, {grown(swollen)}, four_teeth(seed)));
    EXPECT_FALSE(has_name(root)) << list(root);
  }
  const auto scan = close(gear, scan_of(gear, {grown(plated)}, scanned(8000, 1.5, 4)), true);
  EXPECT_FALSE(has_name(scan)) << list(scan);
  EXPECT_NE(list(scan).find("more and more over the profile towards the tip"), std::string::npos)
      << list(scan);
}

TEST(OneForm, ARiseTowardsTheUpperEndIsNoGrooveBesideAKink) {
  // A foot of a scan that lies upside down.
  const MadeGear gear = spur(14);
  const auto swollen = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return 40.0 * std::exp(-0.5 * (1.0 - s.v) * g.face_mm / (0.1 * g.face_mm));
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result =
        close(gear, scan_of(gear, {grown(swollen)}, scanned(10000, 2.3, seed)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NE(list(result).find("more and more over the face towards the upper end"),
              std::string::npos)
        << list(result);
  }
}

TEST(OneForm, AHollowInTheMiddleOfEveryFlankIsNoWear) {
  const MadeGear gear = spur(40);
  const auto sunk = [](auto&, const FlankSpot& s, auto&) {
    return -14.0 * std::exp(-s.u * s.u / 0.36 - s.v * s.v / 0.25);
  };
  std::string told;
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(sunk)}, scanned(9000, 4.0, seed)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    told += list(result) + "\n";
  }
  EXPECT_NE(told.find("a hollow of the flank at a diameter of"), std::string::npos)
      << told;
}

TEST(OneForm, ARootReliefOnThreeTeethIsNoWear) {
  const MadeGear gear = spur(31);
  const auto relieved = [](auto&, const FlankSpot& s, auto&) {
    const double share = 0.5 * (s.u + 1.0);
    return -11.0 * std::max(0.0, 0.35 - share) / 0.35;
  };
  InspectionOptions options = four_teeth(1);
  options.teeth = {1, 11, 21};
  for (options.seed = 1; options.seed <= survey_size(2U, 4U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(relieved)}, options));
    EXPECT_FALSE(has_name(result)) << list(result);
  }
}

TEST(OneForm, AKinkOfFourTeethIsNoWearThatAWaveMends) {
  const MadeGear gear = spur(24);
  const auto bent = [](auto&, const FlankSpot& s, auto&) {
    return -17.0 * std::max(0.0, s.u + 0.3) / 1.3;
  };
  InspectionOptions options;
  options.teeth = {1, 5, 10, 14};
  options.points = 120;
  options.noise_um = 1.4;
  options.index = false;
  for (options.seed = 11; options.seed <= survey_size(11U, 14U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(bent)}, options));
    EXPECT_FALSE(has_name(result)) << list(result);
  }
}

TEST(OneForm, AnSOverTheProfileIsNoWearBesideARelief) {
  const MadeGear gear = spur(36);
  const auto bent = [](auto&, const FlankSpot& s, auto&) {
    return 3.2 * std::sin(M_PI * s.u) + 2.3 * s.u;
  };
  InspectionOptions options;
  options.teeth = {1, 5, 10, 14, 19, 23, 28, 32};
  options.points = 120;
  options.noise_um = 0.5;
  for (options.seed = 1; options.seed <= survey_size(1U, 3U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(bent)}, options));
    EXPECT_EQ(find(result, "flank_wear"), nullptr) << list(result);
    EXPECT_EQ(find(result, "tip_relief"), nullptr) << list(result);
  }
}

TEST(OneForm, ADentOfEveryFourthToothIsNoWearOfAll) {
  const MadeGear gear = spur(26);
  const auto dented = [](auto&, const FlankSpot& s, auto&) {
    const double off = (s.u + 0.2) / 0.16;
    return s.side < 0 && s.tooth % 4 == 1 ? -7.0 * std::exp(-off * off) : 0.0;
  };
  InspectionOptions options;
  options.points = 31;
  options.noise_um = 0.7;
  for (options.seed = 1; options.seed <= survey_size(1U, 3U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(dented)}, options));
    EXPECT_EQ(find(result, "flank_wear"), nullptr) << list(result);
    EXPECT_NE(result.verdict, loop::Verdict::kNoEffect);
  }
}

TEST(OneForm, AGrowthAboveAHeightIsNoScale) {
  const MadeGear gear = spur(19);
  const Process pressed{.move_um = [](const MadeGear&, const FlankSpot& s, const Vec3& p) -> Vec3 {
    const double r = std::hypot(p[0], p[1]), a = 40.0 / (1.0 + std::exp(-s.v / 0.12));
    return {a * p[0] / r, a * p[1] / r, 0.0};
  }};
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {pressed}, scanned(9000, 5.0, seed)), true);
    EXPECT_EQ(find(result, "scale"), nullptr) << list(result);
    EXPECT_EQ(find(result, "contour_offset"), nullptr) << list(result);
    EXPECT_EQ(find(result, "tooth_thickness"), nullptr) << list(result);
  }
}

TEST(OneForm, RibsThatPressOutwardsAreNoScale) {
  const MadeGear gear = spur(40);
  const Process ribs{.move_um = [](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    const double r = std::hypot(p[0], p[1]);
    const double a = 36.0 * std::pow(std::max(0.0, std::cos(5.0 * std::atan2(p[1], p[0]))), 4);
    return {a * p[0] / r, a * p[1] / r, 0.0};
  }};
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {ribs}, scanned(9000, 5.0, seed)), true);
    EXPECT_EQ(find(result, "scale"), nullptr) << list(result);
    EXPECT_EQ(find(result, "contour_offset"), nullptr) << list(result);
  }
}

TEST(OneForm, BacklashOfAPrintersAxisIsNoUnequalAxes) {
  const MadeGear gear = spur(40);
  const auto lagging = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const Vec3 p = point_on(g, s), n = normal_at(g, s);
    return 14.0 * n[0] * (std::atan2(p[1], p[0]) > 0.0 ? -1.0 : 1.0);
  };
  const auto result = close(gear, scan_of(gear, {grown(lagging)}, scanned(9000, 4.0, 1)), true);
  EXPECT_EQ(find(result, "scale_xy"), nullptr) << list(result);
  EXPECT_EQ(find(result, "skew"), nullptr) << list(result);
}

TEST(OneForm, AFormOfOneFlankSaysWhich) {
  const MadeGear gear = spur(24);
  const auto step = [](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 && s.v > 0.2 ? 8.0 : 0.0;
  };
  const auto result = close(gear, inspection_of(gear, {grown(step)}, four_teeth(1)));
  ASSERT_FALSE(result.effects.empty());
  EXPECT_NE(result.effects[0].sentence.find("right flanks alone"), std::string::npos)
      << result.effects[0].sentence;
}

// What the rules above must leave alone.
TEST(OneForm, TwoNamesThatAreTrueStay) {
  const MadeGear gear = spur(24);
  const auto both = [](auto&, const FlankSpot& s, auto&) { return 3.0 * s.u - 5.0 * s.u * s.u; };
  const auto cone = [](auto&, const FlankSpot& s, auto&) { return 4.0 * s.v - 5.0 * s.v * s.v; };
  const auto worn = [](auto&, const FlankSpot& s, auto&) {
    return -9.0 * std::exp(-std::pow((s.u - 0.55) / 0.4, 2));
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto profile = close(gear, inspection_of(gear, {grown(both)}, four_teeth(seed)));
    EXPECT_NE(find(profile, "pressure_angle_error"), nullptr) << list(profile);
    EXPECT_NE(find(profile, "profile_crowning"), nullptr) << list(profile);
    const auto face = close(gear, inspection_of(gear, {grown(cone)}, four_teeth(seed)));
    EXPECT_NE(find(face, "taper"), nullptr) << list(face);
    EXPECT_NE(find(face, "crowning"), nullptr) << list(face);
    const auto wear = close(gear, inspection_of(gear, {grown(worn)}, four_teeth(seed)));
    EXPECT_NE(find(wear, "flank_wear"), nullptr) << list(wear);
  }
}

TEST(OneForm, AScaleStaysBesideAFormThatLeavesMostOfTheFaceAlone) {
  const MadeGear gear = spur(19);
  const auto ridge = [](auto&, const FlankSpot& s, auto&) {
    return 12.0 * std::exp(-std::pow((s.v - 0.2) / 0.1, 2));
  };
  Process both = grown(ridge);
  both.move_um = [](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    return {2.0 * p[0], 2.0 * p[1], 2.0 * p[2]};
  };
  const auto result = close(gear, scan_of(gear, {both}, scanned(9000, 3.0, 1)), true);
  ASSERT_NE(find(result, "scale"), nullptr) << list(result);
  EXPECT_NEAR(parameter(*find(result, "scale"), "percent").value, 0.2, 0.01);
}

}  // namespace
}  // namespace trueflank::test
