// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// What a section has alike at every height: pixels, and patterns without a period.
namespace trueflank::test {
namespace {

/// Walls that stand where x and y of every point rounded to steps would put them.
Process pixels(double step_mm) {
  return grown([=](const MadeGear& gear, const FlankSpot& spot, const Vec3& p) {
    const auto off = [&](double at) { return 1e3 * (step_mm * std::round(at / step_mm) - at); };
    const Vec3 n = normal_at(gear, spot);
    return off(p[0]) * n[0] + off(p[1]) * n[1];
  });
}

/// Another height in every cell over the profile of every flank, at all heights.
Process fine_pattern(double um, unsigned seed) {
  return grown([=](const MadeGear&, const FlankSpot& s, const Vec3&) {
    const auto cell = static_cast<unsigned>(60.0 * (s.u + 1.0));
    std::mt19937 random(cell + 1000U * static_cast<unsigned>(2 * s.tooth + s.side) +
                        100000U * seed);
    return std::normal_distribution<double>(0.0, um)(random);
  });
}

std::size_t rounded_axes(const loop::LoopResult& result, double step_mm) {
  std::size_t count = 0;
  for (const loop::FoundEffect& effect : result.effects)
    for (const loop::Term& term : effect.terms)
      if (term.text.find("is rounded to steps") != std::string::npos &&
          std::abs(term.shape.at(2) - step_mm) < 0.002 * step_mm)
        ++count;
  return count;
}

// A judge's pixels of 39 um were noise of 11.9 um for 3.1.
TEST(Pixels, OfBothAxesAreTheirStepsAndNoNoise) {
  for (unsigned seed = 1; seed <= survey_size(2U, 10U); ++seed) {
    const MadeGear gear = spur(24);
    const double step_mm = 0.02 + 0.007 * seed;
    const auto result =
        close(gear, scan_of(gear, {pixels(step_mm)}, scanned(7000, 3.0, seed)), true);
    EXPECT_EQ(rounded_axes(result, step_mm), 2U) << step_mm << ": " << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << step_mm << ": " << list(result);
    EXPECT_LT(result.noise, 3.6) << step_mm << ": " << list(result);
  }
}

Process tapered() {
  return grown([](const MadeGear&, const FlankSpot& s, const Vec3&) { return 14.0 * s.v; });
}

TEST(Pixels, StandBesideATaper) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(27);
    const auto result =
        close(gear, scan_of(gear, {pixels(0.05), tapered()}, scanned(7000, 3.0, seed)), true);
    EXPECT_EQ(rounded_axes(result, 0.05), 2U) << seed << ": " << list(result);
    EXPECT_NE(find(result, "taper"), nullptr) << seed << ": " << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << seed << ": " << list(result);
  }
}

// Off the axis they lie on no grid of its frame: a pattern, whose noise is the true one.
TEST(Pixels, OfAPartOffItsAxisAreAPatternAlikeAtEveryHeight) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(27);
    const auto result = close(gear,
                              scan_of(gear, {pixels(0.05), off_centre(8.0, 55.0 * seed), tapered()},
                                      scanned(7000, 3.0, seed)),
                              true);
    EXPECT_TRUE(tells(result, "alike at every height")) << seed << ": " << list(result);
    EXPECT_NE(find(result, "eccentricity"), nullptr) << seed << ": " << list(result);
    EXPECT_NE(find(result, "taper"), nullptr) << seed << ": " << list(result);
    EXPECT_LT(result.noise, 5.0) << seed << ": " << list(result);
  }
}

TEST(Pixels, APatternWithoutAPeriodIsSaidToBeLeft) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(24);
    const auto result =
        close(gear, scan_of(gear, {fine_pattern(8.0, seed)}, scanned(7000, 3.0, seed)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << seed << ": " << list(result);
    EXPECT_TRUE(tells(result, "alike at every height")) << seed << ": " << list(result);
    // (some pairs lie on both sides of an edge)
    EXPECT_LT(result.noise, 4.2) << seed << ": " << list(result);
    EXPECT_EQ(rounded_axes(result, 0.05), 0U) << seed << ": " << list(result);
  }
}

TEST(Pixels, NoiseOfAnyKindIsNone) {
  for (unsigned seed = 1; seed <= survey_size(2U, 12U); ++seed) {
    const MadeGear gear = seed % 2 == 0 ? helical(25, 18.0) : spur(23);
    ScanOptions options = scanned(6000, 4.0, seed);
    options.correlation = seed % 3 == 0 ? 0.7 : 0.0;
    options.outlier_share = seed % 3 == 1 ? 0.01 : 0.0;
    const auto result = close(gear, scan_of(gear, {}, options), true);
    EXPECT_FALSE(tells(result, "alike at every height")) << seed << ": " << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
