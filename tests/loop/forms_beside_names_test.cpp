// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/loop/made_gears.h"

// A form without a name beside an effect that has one: each hid the other, and both were told as
// many pieces. Forms that do not run over the whole gear, or not on both flanks.
namespace trueflank::test {
namespace {

constexpr double kPi = std::numbers::pi;

double size_of(const loop::LoopResult& result, const std::string& effect,
               const std::string& parameter_name) {
  const loop::FoundEffect* found = find(result, effect);
  return found == nullptr ? NAN : parameter(*found, parameter_name).value;
}

TEST(StepOfAllFlanks, StandsBesideAHelixError) {
  const MadeGear gear = spur(27);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.v > 0.1 ? 6.0 : 0.0) + 4.0 * s.side * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(8000, 1.0, seed)), true);
    EXPECT_NEAR(std::abs(size_of(result, "helix_error", "slope_um")), 8.0, 0.4) << list(result);
    EXPECT_TRUE(tells(result, "a step over the face")) << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(StepOfOneFlank, StandsBesideAPressureAngle) {
  const MadeGear gear = spur(31);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.side > 0 && s.u > 0.15 ? 6.0 : 0.0) - 7.0 * s.u;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(9000, 1.0, seed)), true);
    EXPECT_NEAR(size_of(result, "pressure_angle_error", "slope_um"), -14.0, 0.7) << list(result);
    EXPECT_TRUE(tells(result, "a step over the profile")) << list(result);
    EXPECT_FALSE(tells(result, "kink")) << list(result);
  }
}

TEST(EqualAndOneSidedSlopes, AreOneOppositeSlope) {
  const MadeGear gear = spur(25);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    const double beyond = std::max(0.0, s.v - 0.15) / 0.85;
    return 45.0 * beyond * beyond + 20.0 * s.side * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(9000, 5.0, seed)), true);
    EXPECT_NEAR(std::abs(size_of(result, "helix_error", "slope_um")), 40.0, 2.0) << list(result);
    EXPECT_EQ(find(result, "taper"), nullptr) << list(result);
  }
}

TEST(TracesThatLeanByThemselves, AreTold) {
  const MadeGear gear = spur(40);
  for (const std::vector<int>& teeth :
       {std::vector<int>{1, 11, 21, 31}, {1, 6, 11, 16, 21, 26, 31, 36}}) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::vector<double> lean(2 * 41);
    for (double& one : lean) one = 2.5 * normal(random);
    const auto own = [&](auto&, const FlankSpot& s, auto&) {
      return lean[static_cast<std::size_t>(2 * s.tooth + (s.side > 0 ? 1 : 0) - 1)] * s.v;
    };
    const auto result = close(gear, inspection_of(gear, {grown(own)}, traced(teeth, 0.5, 3)));
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_NE(result.structure_left.find("the traces over the face lean each by itself"),
              std::string::npos)
        << result.structure_left;
    // The slopes are no noise of the measurement.
    EXPECT_LT(result.noise, 0.65) << list(result);
  }
}

TEST(DriftOfOneFlank, IsOneFormBesideACrowning) {
  const MadeGear gear = spur(29);
  const auto made = [&](auto&, const FlankSpot& s, auto&) {
    return (s.side > 0 ? 13.0 * (s.tooth - 1.0) / gear.teeth : 0.0) - 14.0 * s.v * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(12000, 2.0, seed)), true);
    EXPECT_TRUE(tells(result, "from tooth 1 on, once around, the height drifts evenly"))
        << list(result);
    EXPECT_NEAR(size_of(result, "crowning", "amount_um"), 14.0, 0.8) << list(result);
    EXPECT_FALSE(tells(result, "per turn")) << list(result);
  }
}

TEST(CrowningThatGrowsOnceAround, IsOneDriftBesideATilt) {
  const MadeGear gear = spur(44);
  const auto made = [&](auto&, const FlankSpot& s, auto&) {
    const double since = (s.tooth - 7 + gear.teeth) % gear.teeth;
    return 8.0 * since / gear.teeth * (1.0 / 3.0 - s.v * s.v);
  };
  const auto result =
      close(gear, scan_of(gear, {grown(made), leaning(0.8, 60.0)}, scanned(9000, 0.8, 3)), true);
  EXPECT_NE(find(result, "axis_tilt"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "from tooth 7 on, once around, the bow over the face drifts evenly, towards less "
                    "material at both ends"))
      << list(result);
  EXPECT_FALSE(tells(result, "twice per turn")) << list(result);
}

TEST(CombOfOneFlank, IsToldOfThatFlank) {
  const MadeGear gear = spur(36);
  const auto comb = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth % 2 == 0 ? 7.0 : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(comb)}, scanned(8000, 1.5, 2)), true);
  EXPECT_TRUE(tells(result, "every other tooth differs")) << list(result);
  for (const auto& effect : result.effects) {  // opposite: it stands aside, or turns
    if (effect.description.find("every other tooth differs") == std::string::npos) continue;
    EXPECT_EQ(effect.description.find("aside"), std::string::npos) << effect.description;
    EXPECT_EQ(effect.description.find("clockwise"), std::string::npos) << effect.description;
  }
}

TEST(GapThatIsDeeper, IsOneGapWithBothItsWalls) {
  const MadeGear gear = spur(40);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    const bool in_gap = (s.tooth == 20 && s.side > 0) || (s.tooth == 21 && s.side < 0);
    return (in_gap ? -40.0 : 0.0) + 13.0 * s.side * s.v;
  };
  const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(6000, 5.0, 3)), true);
  EXPECT_NE(find(result, "helix_error"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "the gap between teeth 20 and 21 alone is too wide")) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
  EXPECT_FALSE(tells(result, "aside")) << list(result);
}

TEST(LobesOfOneEnd, AreAPartOfTheirFormAndNoCause) {
  const MadeGear gear = helical(40, 12.0);
  const auto pressed = [&](auto&, const FlankSpot& s, auto&) {
    const double theta = 2.0 * kPi * (s.tooth - 1) / gear.teeth;
    return 7.0 * std::exp(-2.0 * (s.v + 1.0)) * std::cos(3.0 * theta - 0.4);
  };
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= 40; ++tooth) teeth.push_back(tooth);
  InspectionOptions options = traced(teeth, 0.4, 2);
  options.index = true;
  const auto result = close(gear, inspection_of(gear, {grown(pressed)}, options));
  EXPECT_TRUE(tells(result, "3 times per turn")) << list(result);
  EXPECT_EQ(find(result, "lobing"), nullptr) << list(result);
}

TEST(BulgeOfOneFlank, LeavesATaperItsName) {
  const MadeGear gear = spur(37);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.side > 0 ? 6.0 * std::pow(std::cos(0.5 * kPi * s.v), 3) : 0.0) + 3.5 * s.v;
  };
  const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(14000, 1.7, 3)), true);
  EXPECT_NEAR(size_of(result, "taper", "slope_um"), 7.0, 0.5) << list(result);
}

TEST(SectorOfFewTeeth, IsOneBesideARelief) {
  const MadeGear gear = spur(21);
  const auto made = [&](auto&, const FlankSpot& s, auto&) {
    const double off = std::max(0.0, s.u - 0.1) / 0.9;
    return ((s.tooth - 2 + gear.teeth) % gear.teeth < 4 ? 10.0 : 0.0) - 20.0 * off * off;
  };
  const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(6000, 3.0, 2)), true);
  EXPECT_TRUE(tells(result, "a sector of 4 teeth from tooth 2 on")) << list(result);
  EXPECT_NE(find(result, "tip_relief"), nullptr) << list(result);
}

TEST(WavesThatGrow, AreOneForm) {
  const MadeGear gear = spur(29);
  const auto grows = [&](auto&, const FlankSpot& s, auto&) {
    const double z_mm = 0.5 * (s.v + 1.0) * gear.face_mm;
    return 9.0 * std::exp(1.3 * (s.v - 1.0)) * std::cos(2.0 * kPi * z_mm / 1.83) + 5.0 * s.v;
  };
  const auto result = close(gear, scan_of(gear, {grown(grows)}, scanned(12000, 1.2, 2)), true);
  EXPECT_TRUE(tells(result, "that grow towards the upper end")) << list(result);
  EXPECT_NEAR(size_of(result, "taper", "slope_um"), 10.0, 0.6) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(WavesFromAPlaceOn, AreOneForm) {
  const MadeGear gear = spur(50);
  const auto windowed = [&](auto&, const FlankSpot& s, auto&) {
    return s.u > 0.0 ? 6.0 * std::sin(2.0 * kPi * 6.0 * (s.u + 1.0) / 2.0) : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(windowed)}, scanned(9000, 1.2, 2)), true);
  EXPECT_TRUE(tells(result, "waves over the profile")) << list(result);
  EXPECT_TRUE(tells(result, "on towards the tip")) << list(result);
  EXPECT_LE(result.effects.size(), 2U) << list(result);
}

TEST(BellMouth, OnTracesIsOneRiseAndNoCrowning) {
  const MadeGear gear = spur(27);
  const auto flared = [](auto&, const FlankSpot& s, auto&) {
    const double from_end = (1.0 - std::abs(s.v)) / 2.0;
    return 7.0 * std::exp(-from_end / 0.11);
  };
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= 27; ++tooth) teeth.push_back(tooth);
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result =
        close(gear, inspection_of(gear, {grown(flared)}, traced(teeth, 1.4, seed)));
    EXPECT_TRUE(tells(result, "more and more over the face towards both ends")) << list(result);
    EXPECT_EQ(find(result, "crowning"), nullptr) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
