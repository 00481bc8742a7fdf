// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/loop/made_gears.h"

// One undeclared form that several names, or many pieces, follow together: it is told as one.
namespace trueflank::test {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

int names_in(const loop::LoopResult& result) {
  return static_cast<int>(std::count_if(result.effects.begin(), result.effects.end(),
                                        [](const auto& effect) { return effect.named; }));
}

TEST(FieldInThePlane, IsNoEccentricityAndNoPitchWave) {
  const MadeGear gear = spur(33);
  // A scanner whose scale along x grows with x.
  const Process field{.move_um = [](const MadeGear& g, const FlankSpot&, const Vec3& p) -> Vec3 {
    const double x = 2.0 * p[0] / (g.module_mm * g.teeth);
    return {5.0 * x * x, 0.0, 0.0};
  }};
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {field}, scanned(9000, 1.0, seed)), true);
    EXPECT_EQ(names_in(result), 0) << list(result);
    EXPECT_TRUE(tells(result, "shifted by the square of where they stand")) << list(result);
  }
}

TEST(GrowsOverProfileTimesFace, IsOneFormAndNoTwist) {
  const MadeGear gear = spur(27);
  const auto cured = [](auto&, const FlankSpot& s, auto&) {
    return 20.0 * std::pow(0.5 * (1.0 - s.u), 2) * 0.5 * (1.0 + s.v);
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(cured)}, scanned(9000, 2.0, seed)), true);
    EXPECT_EQ(names_in(result), 0) << list(result);
    EXPECT_TRUE(tells(result,
                      "grows towards the root by the square, and that the more, towards the "
                      "upper end evenly"))
        << list(result);
  }
}

TEST(CrownedTheMoreTowardsTheTip, IsOneForm) {
  const MadeGear gear = spur(30);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return -6.0 * 0.5 * (1.0 + s.u) * s.v * s.v;
  };
  const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(9000, 1.0, 3)), true);
  EXPECT_EQ(names_in(result), 0) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

TEST(WaveThatDoesNotClose, IsNoToothAndNoDrift) {
  const MadeGear gear = spur(34);
  const auto run_out = [&](auto&, const FlankSpot& s, auto&) {
    return 9.0 * s.side * std::cos(2.0 * kHalfTurn * 2.5 * (s.tooth - 1.0) / gear.teeth - 0.7);
  };
  InspectionOptions options;
  options.points = 60;
  options.noise_um = 1.0;
  for (options.seed = 1; options.seed <= survey_size(1U, 2U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(run_out)}, options));
    EXPECT_EQ(names_in(result), 0) << list(result);
    EXPECT_TRUE(tells(result, "2.5 periods a turn")) << list(result);
  }
}

TEST(TeethThatDriftAside, AreOneDriftBesideAnEccentricity) {
  const MadeGear gear = spur(36);
  const Process creeping{.move_um = [](const MadeGear& g, const FlankSpot& s, const Vec3&) -> Vec3 {
    const double since = (s.tooth - 1.0) / g.teeth;
    return {6.0 - 10.0 * since, 12.0 * since, 0.0};
  }};
  const auto result = close(gear, scan_of(gear, {creeping}, scanned(12000, 2.0, 4)), true);
  EXPECT_NE(find(result, "eccentricity"), nullptr) << list(result);
  EXPECT_EQ(names_in(result), 1) << list(result);
  EXPECT_TRUE(tells(result, "from tooth 1 on, once around, the teeth drift aside")) << list(result);
}

TEST(WaveThatChangesSignFromToothToTooth, IsNoGhostOrder) {
  const MadeGear gear = spur(26);
  const auto two_starts = [](auto&, const FlankSpot& s, auto&) {
    return (s.tooth % 2 == 0 ? 1.0 : -1.0) * 6.0 * std::cos(kHalfTurn * 1.8 * s.u + 0.4);
  };
  InspectionOptions options;
  options.points = 60;
  options.noise_um = 1.0;
  options.seed = 5;
  const auto result = close(gear, inspection_of(gear, {grown(two_starts)}, options));
  EXPECT_EQ(names_in(result), 0) << list(result);
  EXPECT_TRUE(tells(result, "13 periods a turn")) << list(result);
  EXPECT_LT(result.noise, 1.3) << list(result);
}

TEST(BowThatComesAndGoesOncePerTurn, IsNoPitchWaveInTheMiddle) {
  const MadeGear gear = spur(33);
  const auto quenched = [&](auto&, const FlankSpot& s, auto&) {
    return 3.0 * s.side * s.v * s.v *
           (1.0 + std::cos(2.0 * kHalfTurn * (s.tooth - 1.0) / gear.teeth - 0.6)) / 2.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(quenched)}, scanned(12000, 0.6, 2)), true);
  EXPECT_EQ(names_in(result), 0) << list(result);
}

TEST(StripWithSteepSides, IsNoCrowningOfItsFlank) {
  const MadeGear gear = spur(31);
  const auto track = [](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 && s.v > -0.55 && s.v < 0.4 ? -5.0 : 0.0;
  };
  for (const std::vector<int>& teeth :
       {std::vector{1, 9, 17, 25}, std::vector{1, 6, 11, 16, 21, 26}}) {
    const auto result = close(gear, inspection_of(gear, {grown(track)}, traced(teeth, 0.7, 6)));
    EXPECT_EQ(names_in(result), 0) << list(result);
    EXPECT_TRUE(tells(result, "a strip over the face")) << list(result);
  }
  const auto result = close(gear, scan_of(gear, {grown(track)}, scanned(9000, 1.0, 7)), true);
  EXPECT_EQ(names_in(result), 0) << list(result);
  EXPECT_TRUE(tells(result, "a strip over the face")) << list(result);
}

TEST(PatchWithAnEdge, IsOneFormOfItsFlank) {
  const MadeGear gear = spur(29);
  const auto worn = [](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? -9.0 * std::max(0.0, 1.0 - std::pow((s.u - 0.1) / 0.6, 2) -
                                                 std::pow((s.v - 0.3) / 0.45, 2))
                      : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(worn)}, scanned(9000, 1.5, 3)), true);
  EXPECT_EQ(names_in(result), 0) << list(result);
  EXPECT_TRUE(tells(result, "a hollow of the flank")) << list(result);
}

TEST(WavesOfOneLengthOnBothFlanks, AreNoPolynomialsBesideThem) {
  const MadeGear gear = spur(28);
  const auto hobbed = [](auto&, const FlankSpot& s, auto&) {
    return 10.0 * std::cos(kHalfTurn * 1.7 * s.u + (s.side > 0 ? 0.4 : 2.3));
  };
  const auto result = close(gear, scan_of(gear, {grown(hobbed)}, scanned(9000, 2.0, 8)), true);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
  EXPECT_FALSE(tells(result, "degree")) << list(result);
}

}  // namespace
}  // namespace trueflank::test
