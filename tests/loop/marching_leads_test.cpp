// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Waves over the face in helix traces whose phase runs on from tooth to tooth.
namespace trueflank::test {
namespace {

struct March {
  int teeth = 0;
  double waves = 0.0;  // over the face
  double order = 0.0;  // periods a turn
  double phase = 0.0, um = 0.0;
  int side = 0;  // 0: both flanks
};

double at(const March& march, const FlankSpot& spot) {
  if (march.side != 0 && spot.side != march.side) return 0.0;
  return march.um * std::cos(2.0 * M_PI *
                                 (march.waves * 0.5 * (spot.v + 1.0) +
                                  march.order * (spot.tooth - 1) / march.teeth) +
                             march.phase);
}

March drawn(std::mt19937_64& random, bool whole) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  March march;
  march.teeth = static_cast<int>(between(17.0, 36.0));
  march.waves = between(2.6, 8.0);
  march.order = between(0.6, 0.45 * march.teeth);
  if (whole) march.order = std::round(march.order);
  if (!whole && std::abs(std::remainder(march.order, 1.0)) < 0.1) march.order += 0.3;
  if (between(-1.0, 1.0) < 0.0) march.order = -march.order;
  march.phase = between(0.0, 2.0 * M_PI);
  march.um = between(3.0, 9.0);
  march.side = static_cast<int>(between(0.0, 3.0)) - 1;
  return march;
}

loop::LoopResult closed(const March& march, bool common_zero, unsigned seed) {
  const MadeGear gear = spur(march.teeth);
  InspectionOptions options;
  options.noise_um = 0.7;
  options.common_zero = common_zero;
  options.points = 60;
  options.seed = seed;
  return close(
      gear,
      inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) { return at(march, s); })},
                    options));
}

/// Size, length and the periods a turn of a wave on these flanks.
void expect_told(const loop::LoopResult& result, const March& march, const std::string& of) {
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << of << list(result);
  EXPECT_TRUE(tells(result, "march from tooth to tooth")) << of << list(result);
  EXPECT_LE(result.effects.size(), march.side == 0 ? 2U : 1U) << of << list(result);
  for (const auto& effect : result.effects) {
    ASSERT_FALSE(effect.terms.empty()) << of << list(result);
    const auto& term = effect.terms.front();
    EXPECT_NEAR(term.amplitude(), march.um, 0.4) << of << list(result);
    ASSERT_GE(term.shape.size(), 3U);
    EXPECT_NEAR(term.shape[1], std::abs(march.waves), 0.1) << of << list(result);
    EXPECT_NEAR(std::abs(term.shape[2]), std::abs(march.order), 0.06) << of << list(result);
  }
}

TEST(MarchingLeads, WavesOfWholeOrdersAreToldWithLengthAndOrder) {
  std::mt19937_64 random(41);
  for (unsigned draw = 0; draw < survey_size(2U, 5U); ++draw) {
    const March march = drawn(random, true);
    expect_told(closed(march, draw % 2 == 0, draw), march, "draw " + std::to_string(draw) + ": ");
  }
}

// A vibration that keeps no step with the turn; half a period a turn more or less, too.
TEST(MarchingLeads, WavesOfNoWholeNumberOfPeriodsAreOneForm) {
  std::mt19937_64 random(42);
  for (unsigned draw = 0; draw < survey_size(3U, 6U); ++draw) {
    March march = drawn(random, false);
    // Half way, and near a whole number.
    if (draw % 3 != 2)
      march.order =
          std::trunc(march.order) + std::copysign(draw % 3 == 0 ? 0.5 : 0.12, march.order);
    const auto result = closed(march, draw % 2 == 0, draw);
    expect_told(result, march, "draw " + std::to_string(draw) + ": ");
    EXPECT_TRUE(tells(result, "no whole number")) << list(result);
  }
}

// Where no whole order beside the first one is left to be seen.
TEST(MarchingLeads, OneThatKeepsStepNearlyIsNoWholeOrder) {
  for (const March& march :
       survey_of(1, {March{17, 5.5, -2.87, 0.4, 9.0, 1}, March{27, 2.6, -6.08, 1.1, 3.5, 0}})) {
    const auto result = closed(march, true, 3);
    expect_told(result, march, "");
    EXPECT_TRUE(tells(result, "no whole number")) << list(result);
  }
}

// Teeth drawn at uneven places, or nearly even ones, whose phases are nearly alike.
TEST(MarchingLeads, OfFewTeethAreToldWithLengthAndOrder) {
  std::mt19937_64 random(44);
  int told = 0;
  constexpr int kDraws = 8;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    March march = drawn(random, true);
    march.teeth = static_cast<int>(std::uniform_real_distribution<double>(26.0, 56.0)(random));
    const auto traced_of = static_cast<std::size_t>(8 + draw % 5);
    std::vector<int> teeth;
    for (int tooth = 1; tooth <= march.teeth; ++tooth) teeth.push_back(tooth);
    std::shuffle(teeth.begin(), teeth.end(), random);
    teeth.resize(traced_of);
    std::sort(teeth.begin(), teeth.end());
    if (draw == 0) {  // as many periods as teeth: the phases go round 1.4 times in all
      march.teeth = 52;
      march.order = 10.0;
      teeth = {2, 7, 12, 18, 23, 28, 33, 38, 44, 49};
    }
    const MadeGear gear = spur(march.teeth);
    InspectionOptions options = traced(teeth, 0.08 * march.um, draw);
    options.profile = draw % 2 == 0;
    const auto result = close(
        gear,
        inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) { return at(march, s); })},
                      options));
    expect_told(result, march, "draw " + std::to_string(draw) + ": ");
    told += tells(result, "march from tooth to tooth") ? 1 : 0;
  }
  EXPECT_EQ(told, kDraws);
}

// The same on every tooth: no order is sought in what errors leave of it.
TEST(MarchingLeads, OfFewTeethAreNoneWhereAllTeethAreAlike) {
  std::mt19937_64 random(45);
  for (unsigned draw = 0; draw < 4; ++draw) {
    March march = drawn(random, true);
    march.order = 0.0;
    const MadeGear gear = spur(march.teeth);
    const auto result = close(
        gear,
        inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) { return at(march, s); })},
                      traced({1, 4, 6, 11, 15}, 0.7, draw)));
    EXPECT_FALSE(tells(result, "march from tooth to tooth")) << draw << list(result);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << draw << list(result);
  }
}

// Where every second tooth has traces, an order looks like others: none is told.
TEST(MarchingLeads, OfEverySecondToothNoOrderIsTold) {
  std::mt19937_64 random(43);
  March march = drawn(random, true);
  march.teeth = 24;
  const MadeGear gear = spur(march.teeth);
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= march.teeth; tooth += 2) teeth.push_back(tooth);
  const auto result = close(
      gear,
      inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) { return at(march, s); })},
                    traced(teeth, 0.7, 1)));
  EXPECT_NE(result.verdict, loop::Verdict::kNoEffect) << list(result);
  EXPECT_FALSE(tells(result, "march from tooth to tooth")) << list(result);
}

}  // namespace
}  // namespace trueflank::test
