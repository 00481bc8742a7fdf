// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/loop/made_gears.h"

// A straight slope beside waves that change their length along the same direction.
namespace trueflank::test {
namespace {

struct SlopeDraw {
  double noise_um, slope_um, wave_um;
};
double drawn_between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
SlopeDraw slope_drawn(std::mt19937_64& random) {
  const double noise = drawn_between(random, 0.4, 1.5);
  return {noise, drawn_between(random, 5.0, 8.0) * noise * (random() % 2 == 0 ? 1.0 : -1.0),
          drawn_between(random, 5.0, 12.0) * noise};
}
/// Waves: 2.5 at the root or the lower end, in all of the length 5.
double wave_at(double share) { return std::cos(2.0 * M_PI * 2.5 * (share + share * share)); }

loop::LoopResult closed(const SlopeDraw& draw, bool face, unsigned seed,
                        const std::function<double(double)>& beside) {
  const MadeGear gear = spur(38);
  InspectionOptions options = traced({2, 8, 15, 21, 27, 34}, draw.noise_um, seed);
  options.points = 160;
  options.profile = !face;
  options.helix = face;
  return close(gear, inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) {
                                     const double share = 0.5 * ((face ? s.v : s.u) + 1.0);
                                     return draw.wave_um * wave_at(share) + beside(share);
                                   })},
                                   options));
}

TEST(SlopesBesideWaves, OverTheProfileAreAnAngleAndNoWear) {
  const int kDraws = survey_size(4, 12);
  for (unsigned seed = 1; seed <= static_cast<unsigned>(kDraws); ++seed) {
    std::mt19937_64 random(seed);
    const SlopeDraw draw = slope_drawn(random);
    const auto result =
        closed(draw, false, seed, [&](double share) { return draw.slope_um * (share - 0.5); });
    EXPECT_EQ(result.effects.size(), 2U) << seed << list(result);
    EXPECT_TRUE(tells(result, "that change their length")) << seed << list(result);
    expect_size(result, "pressure_angle_error", "slope_um", draw.slope_um,
                0.08 * std::abs(draw.slope_um));
  }
}

TEST(SlopesBesideWaves, OverTheFaceAreATaper) {
  const int kDraws = survey_size(2, 8);
  for (unsigned seed = 1; seed <= static_cast<unsigned>(kDraws); ++seed) {
    std::mt19937_64 random(20 + seed);
    const SlopeDraw draw = slope_drawn(random);
    const auto result =
        closed(draw, true, seed, [&](double share) { return draw.slope_um * (share - 0.5); });
    EXPECT_EQ(result.effects.size(), 2U) << seed << list(result);
    expect_size(result, "taper", "slope_um", draw.slope_um, 0.08 * std::abs(draw.slope_um));
  }
}

// What bends there stays.
TEST(SlopesBesideWaves, AReliefOrAWearBesideThemIsNoSlope) {
  const int kDraws = survey_size(4, 12);
  for (unsigned seed = 1; seed <= static_cast<unsigned>(kDraws); ++seed) {
    std::mt19937_64 random(40 + seed);
    const SlopeDraw draw = slope_drawn(random);
    const double um = std::abs(draw.slope_um);
    const bool wear = seed % 2 == 0;
    const auto result = closed(draw, false, seed, [&](double share) {
      return wear ? -um * std::exp(-std::pow((share - 0.3) / 0.2, 2))
                  : -um * std::pow(std::max(share - 0.6, 0.0) / 0.4, 2);
    });
    EXPECT_EQ(find(result, "pressure_angle_error"), nullptr) << seed << list(result);
    EXPECT_NE(result.verdict, loop::Verdict::kNoEffect) << seed << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
