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

/// Stripes over the whole part, as lines of an infill press through its walls: um along the normal.
auto stripes(double um, double length_mm) {
  return [=](const MadeGear&, const FlankSpot&, const Vec3& p) {
    return um * std::cos(kTurn * (0.8 * p[0] + 0.6 * p[1]) / length_mm);
  };
}

TEST(FlankWaves, ProfilesThatEveryFlankHasForItselfAreNoNoise) {
  const MadeGear gear = spur(29);
  for (const unsigned seed : {11u, 12u}) {
    const auto result = close(gear, scan_of(gear, {grown(stripes(9.0, 1.9))}, scan_with(3.0, seed)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_NE(result.structure_left.find("every flank has a form of its own over the profile"),
              std::string::npos)
        << result.structure_left;
    EXPECT_NEAR(result.noise, 3.0, 0.6);
    for (const auto& effect : result.effects) EXPECT_FALSE(effect.named) << list(result);
  }
}

/// Chatter that begins anew on every flank: so many waves over profile and face.
auto chatter(double um, double waves_profile, double waves_face, unsigned seed, bool mirrored) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> phase(0.0, kTurn);
  std::vector<double> phases(2 * 101);
  for (double& one : phases) one = phase(random);
  return [=](const MadeGear&, const FlankSpot& s, const Vec3&) {
    const double face = mirrored && s.side < 0 ? -waves_face : waves_face;
    return um * std::cos(kTurn * 0.5 * (waves_profile * (s.u + 1.0) + face * (s.v + 1.0)) +
                         phases[static_cast<std::size_t>(2 * s.tooth + (s.side > 0 ? 1 : 0))]);
  };
}

TEST(FlankWaves, ChatterInAPhaseOfItsOwnOnEveryFlankIsNoNoise) {
  // (it was `no_effect`, with all of it called noise)
  const MadeGear gear = spur(37);
  for (const bool mirrored : {false, true}) {
    const auto result =
        close(gear,
              scan_of(gear, {grown(chatter(6.0, 2.3, 3.1, mirrored ? 3 : 4, mirrored))},
                      scan_with(3.0, 21)),
              true);
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_NE(result.structure_left.find("in a phase of its own on every flank"), std::string::npos)
        << result.structure_left;
    EXPECT_NE(result.structure_left.find(mirrored ? " flanks and "
                                                  : "falling towards the tip, in a phase"),
              std::string::npos)
        << result.structure_left;
    EXPECT_NEAR(result.noise, 3.0, 0.25);
  }
}

TEST(FlankWaves, ErrorsThatHangTogetherAlongLinesAreNoWavesOfFlanks) {
  // Each value keeps some of the one before it: lines of a scanner.
  const MadeGear gear = spur(37);
  for (const unsigned seed : {31u, 32u, 33u, 34u}) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    double last = 0.0;
    const auto lines = [&](auto&, const FlankSpot&, auto&) {
      return last = 0.8 * last + 3.0 * normal(random);
    };
    const auto result = close(gear, scan_of(gear, {grown(lines)}, scan_with(1.0, seed)), true);
    EXPECT_EQ(result.structure_left.find("in a phase of its own on every flank"), std::string::npos)
        << result.structure_left;
  }
}

TEST(FlankWaves, AMachinesOrderAboveTheCandidatesIsNamedInAScan) {
  const MadeGear gear = spur(29);
  const auto ghost = [&](auto&, const FlankSpot& s, const Vec3& p) {
    const double unwound = roll_of_radius(gear, std::hypot(p[0], p[1])) / gear.base();
    // Either flank is cut at another place of the machine's turn.
    return 6.0 * std::cos(95.0 * (kTurn * (s.tooth - 1) / 29.0 + s.side * (0.05 - unwound)));
  };
  const auto result = close(gear, scan_of(gear, {grown(ghost)}, scan_with(2.5, 13)), true);
  ASSERT_FALSE(result.effects.empty());
  for (const auto& effect : result.effects) {
    EXPECT_EQ(effect.id, "ghost_order") << list(result);
    EXPECT_EQ(parameter(effect, "order").value, 95.0);
  }
  EXPECT_LT(result.after.held_out_rms, 1.15 * 2.5);
}

/// The values of a mesh of rows over the face, as they stand in a scan.
loop::ScanData rows_of(const MadeGear& gear, const Process& process, int rows, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 2.0);
  loop::ScanData scan;
  for (int tooth = 1; tooth <= gear.teeth; ++tooth)
    for (const int side : {1, -1})
      for (int i = 0; i < rows; ++i)
        for (int k = 0; k < 10; ++k) {
          const FlankSpot spot{tooth, side, -0.95 + 0.2 * k, -0.99 + 1.98 * i / (rows - 1.0)};
          scan.points_mm.push_back(made_point(gear, spot, {process, grown([&](auto&, auto&, auto&) { return noise(random); })}));
        }
  return scan;
}

TEST(FlankWaves, ARidgeOnAMeshOfRowsIsOneRidgeAndNoShortWave) {
  const MadeGear gear = spur(29);
  const auto ridge = grown([](auto&, const FlankSpot& s, auto&) {
    return 14.0 * std::exp(-std::pow((s.v + 0.2) / 0.12, 2));
  });
  const auto result = close(gear, rows_of(gear, ridge, 25, 21), true);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  ASSERT_EQ(result.effects[0].terms.size(), 1u) << list(result);
  EXPECT_NE(result.effects[0].description.find("a ridge over the face"), std::string::npos);
  EXPECT_NEAR(std::stod(result.effects[0].description.substr(result.effects[0].description.find("height of ") + 10)),
              4.0, 0.1);
  EXPECT_NEAR(result.noise, 2.0, 0.15);
}

TEST(FlankWaves, ASlowFormOnAMeshOfRowsIsNoShortWave) {
  const MadeGear gear = spur(29);
  const auto bent = grown([](auto&, const FlankSpot& s, auto&) {
    return 9.0 * s.v * std::cos(3.0 * kTurn * (s.tooth - 1) / 29.0);
  });
  const auto result = close(gear, rows_of(gear, bent, 17, 22), true);
  ASSERT_FALSE(result.effects.empty());
  for (const auto& effect : result.effects)
    EXPECT_EQ(effect.description.find("waves across the flanks"), std::string::npos) << list(result);
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

TEST(GhostOrders, ThatGrowAndShrinkOnceATurnAreNotCountedBackwards) {
  // On 18 teeth an order of 46 counted the other way follows one of 44 nearly as well.
  const MadeGear gear = spur(18);
  // (draws in which the other count looks surer)
  for (const unsigned seed : {50U, 160U, 185U}) {
    const auto ghost = [seed](const MadeGear& g, const FlankSpot& s, auto&) {
      const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
      const double turned = (from + 0.5 * (s.u + 1.0) * (to - from)) / g.base();
      const double around = 2.0 * M_PI * (s.tooth - 1) / g.teeth;
      return 1.2 * (1.0 + 0.8 * std::cos(around - 0.8 * seed)) *
             std::cos(44.0 * (around - s.side * turned) + seed + s.side);
    };
    InspectionOptions options = traced({}, 0.37, seed);
    options.helix = false;
    options.points = 48;
    options.correlation = 0.5;
    const auto result = close(gear, inspection_of(gear, {grown(ghost)}, options));
    EXPECT_FALSE(tells(result, "counted clockwise")) << list(result);
    EXPECT_TRUE(std::any_of(result.effects.begin(), result.effects.end(), [](const auto& effect) {
      return effect.id == "ghost_order" && parameter(effect, "order").value == 44.0;
    })) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
