// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/loop/made_gears.h"

// Waves across the flanks of a scan, flanks that stand each by itself, and names where forms say no more.
namespace trueflank::test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

ScanOptions scan_with(double noise_um, unsigned seed) {
  ScanOptions options;
  options.points = 6000;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

TEST(FlankWaves, MarksThatRunSlantingOverTheFlanksAreFoundWithTheirLengths) {
  const MadeGear gear = spur(29);
  const auto marks = [](auto&, const FlankSpot& s, auto&) {
    return 9.0 * std::sin(kTurn * (1.8 * 0.5 * (s.u + 1.0) + 7.3 * 0.5 * (s.v + 1.0)));
  };
  const auto result = close(gear, scan_of(gear, {grown(marks)}, scan_with(2.5, 1)), true);
  ASSERT_FALSE(result.effects.empty());
  for (const auto& effect : result.effects) {
    EXPECT_FALSE(effect.named) << list(result);
    EXPECT_NE(effect.description.find("waves across the flanks"), std::string::npos) << list(result);
    EXPECT_NE(effect.description.find("falling towards the tip, the same on every tooth"), std::string::npos);
  }
  EXPECT_NEAR(result.noise, 2.5, 0.15);
  EXPECT_LT(result.after.held_out_rms, 1.15 * 2.5);
}

TEST(FlankWaves, MarksThatMarchFromToothToToothAreFound) {
  const MadeGear gear = spur(29);
  const auto marks = [](auto&, const FlankSpot& s, auto&) {
    return 8.0 * std::cos(kTurn * (5.4 * 0.5 * (s.v + 1.0) + 3.0 * (s.tooth - 1) / 29.0));
  };
  const auto result = close(gear, scan_of(gear, {grown(marks)}, scan_with(2.5, 2)), true);
  ASSERT_FALSE(result.effects.empty());
  EXPECT_NE(result.effects[0].description.find("march from tooth to tooth: 3 periods a turn"), std::string::npos)
      << list(result);
  EXPECT_LT(result.after.held_out_rms, 1.15 * 2.5);
}

TEST(FlankWaves, FlanksThatStandEachByItselfAreNoNoise) {
  const MadeGear gear = spur(47);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 8.0);
  std::vector<double> height(2 * 48);
  for (double& um : height) um = normal(random);
  const auto pitch = [&](auto&, const FlankSpot& s, auto&) {
    return height[static_cast<std::size_t>(2 * s.tooth + (s.side > 0 ? 1 : 0))];
  };
  const auto result = close(gear, scan_of(gear, {grown(pitch)}, scan_with(3.0, 3)), true);
  EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
  EXPECT_NE(result.structure_left.find("stand each by itself"), std::string::npos)
      << result.structure_left;
  EXPECT_LT(result.noise, 4.5);
}

TEST(FlankWaves, AHollowOfTwentyTimesTheNoiseIsWearAndNoSumOfForms) {
  const MadeGear gear = spur(29);
  const auto hollow = [](auto&, const FlankSpot& s, auto&) {
    return -18.0 * std::exp(-std::pow((s.u - 0.25) / 0.33, 2));
  };
  InspectionOptions options;
  options.points = 60;
  options.noise_um = 0.9;
  options.seed = 4;
  const auto result = close(gear, inspection_of(gear, {grown(hollow)}, options));
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "flank_wear");
  EXPECT_NEAR(parameter(result.effects[0], "depth_um").value, 18.0, 0.6);
}

TEST(FlankWaves, ALeaningProfileIsNotAScaleAndAThickness) {
  const MadeGear gear = spur(16);
  const auto lean = [](auto&, const FlankSpot& s, auto&) {
    return -29.0 * s.u + 83.0 * std::exp(-5.5 * (s.v + 1.0));
  };
  const auto result = close(gear, scan_of(gear, {grown(lean)}, scan_with(3.4, 6)), true);
  EXPECT_NE(find(result, "pressure_angle_error"), nullptr) << list(result);
  EXPECT_EQ(find(result, "scale"), nullptr) << list(result);
}

}  // namespace
}  // namespace trueflank::test
