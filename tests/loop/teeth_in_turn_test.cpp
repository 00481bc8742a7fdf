// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

// What one tooth in so many has at a place of its flanks, and what one tooth alone has there.
namespace trueflank::test {
namespace {

double bell(double off, double half) { return std::exp(-off * off / (half * half)); }

loop::LoopResult closed_on_traces(const MadeGear& gear, const Process& made, double noise_um,
                                  bool common_zero) {
  InspectionOptions options;
  options.noise_um = noise_um;
  options.common_zero = common_zero;
  options.points = 50;
  return close(gear, inspection_of(gear, {made}, options));
}

// A ridge at a height of every fifth tooth, on traces with zeros of their own.
TEST(TeethInTurn, ARidgeOfOneToothInSoManyIsOneForm) {
  for (const auto& [teeth, every, first, sign] : {std::tuple{31, 4, 3, -1.0}, {23, 5, 2, 1.0}}) {
    const MadeGear gear = spur(teeth);
    const auto made =
        grown([every = every, first = first, sign = sign](auto&, const FlankSpot& s, auto&) {
          return (s.tooth - first) % every == 0 ? 7.0 * sign * bell(s.v + 0.3, 0.16) : 0.0;
        });
    const auto result = closed_on_traces(gear, made, 0.7, false);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "on one tooth in " + std::to_string(every) + ", from tooth " +
                                  std::to_string(first) + " on, about a height of"))
        << list(result);
    EXPECT_TRUE(tells(result, sign > 0.0 ? "stand out" : "lie back")) << list(result);
    const auto& term = result.effects.front().terms.front();
    EXPECT_NEAR(term.amplitude(), 7.0, 0.5) << list(result);
  }
}

// Starts of a hob that are ground unlike: as often a turn as a gear that is out of round 14 times.
TEST(TeethInTurn, SlopesThatComeAgainEveryThreeTeethAreNoLobes) {
  const MadeGear gear = spur(42);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) {
    constexpr double kSlopes_um[] = {-2.8, 4.3, -1.5};
    return 0.5 * kSlopes_um[s.tooth % 3] * s.u;
  });
  InspectionOptions options;
  options.noise_um = 0.6;
  options.points = 50;
  options.helix = options.index = false;
  const auto result = close(gear, inspection_of(gear, {made}, options));
  EXPECT_EQ(find(result, "lobing"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "one tooth in 3, from tooth 1 on, leans over the profile"))
      << list(result);
}

// A spot that profile and helix traces cross on one flank of every fifth tooth; the same in a scan.
TEST(TeethInTurn, ASpotOfOneToothInSoManyIsOneForm) {
  const MadeGear gear = spur(34);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth % 5 == 3 ? -11.0 * bell(s.u + 0.1, 0.45) * bell(s.v, 0.25) : 0.0;
  });
  for (const bool scan : {false, true}) {
    const auto result = scan ? close(gear, scan_of(gear, {made}, scanned(12000, 1.5, 5)), true)
                             : closed_on_traces(gear, made, 0.7, true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "on one tooth in 5, from tooth 3 on")) << list(result);
    EXPECT_TRUE(tells(result, "about a diameter of")) << list(result);
    EXPECT_TRUE(tells(result, "about a height of")) << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().amplitude(), 11.0, 1.2) << list(result);
  }
}

// Grease, a nick's burr, a crater: soft towards all sides, seen by one trace in either direction.
TEST(TeethInTurn, ASoftSpotOfOneToothIsOneForm) {
  for (const auto& [teeth, tooth, sign, common_zero] :
       {std::tuple{25, 3, 1.0, false}, {22, 9, -1.0, true}}) {
    const MadeGear gear = spur(teeth);
    const auto made = grown([tooth = tooth, sign = sign](auto&, const FlankSpot& s, auto&) {
      return s.side < 0 && s.tooth == tooth
                 ? sign * 9.0 * bell(s.u + 0.05, 0.5) * bell(s.v - 0.1, 0.3)
                 : 0.0;
    });
    const auto result = closed_on_traces(gear, made, 0.6, common_zero);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "on tooth " + std::to_string(tooth) + " alone, a " +
                                  (sign > 0.0 ? "swelling" : "hollow") + " of the flank"))
        << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().amplitude(), 9.0, 1.0) << list(result);
  }
}

// Three teeth that have nothing to do with each other are no comb, and one tooth is no bell around
// the gear.
TEST(TeethInTurn, TeethAtAnyPlacesAreTheirOwn) {
  const MadeGear gear = spur(29);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && (s.tooth == 4 || s.tooth == 11 || s.tooth == 23)
               ? 9.0 * bell(s.u + 0.05, 0.5) * bell(s.v - 0.1, 0.3)
               : 0.0;
  });
  const auto result = closed_on_traces(gear, made, 0.6, true);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  for (const int tooth : {4, 11, 23})
    EXPECT_TRUE(tells(result, "on tooth " + std::to_string(tooth) + " alone, a swelling"))
        << list(result);
  EXPECT_FALSE(tells(result, "one tooth in")) << list(result);
}

// As from a cutter whose own pitch is uneven: not a wave ten times per turn.
TEST(TeethInTurn, PlacesThatComeAgainEveryFewTeethOfAScanAreAPattern) {
  unsigned patterns = 0;
  const unsigned all = survey_size(2U, 5U);
  for (unsigned seed = 1; seed <= all; ++seed) {
    std::mt19937_64 random(60 + seed);
    std::normal_distribution<double> place(0.0, 9.0);
    const int every = 3;
    const MadeGear gear = spur(every * std::uniform_int_distribution<int>(9, 12)(random));
    std::vector<double> own(static_cast<std::size_t>(every));
    for (double& um : own) um = place(random);
    const auto aside = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side * own[static_cast<std::size_t>((s.tooth - 1) % every)];
    });
    const auto result = close(gear, scan_of(gear, {aside}, scanned(4000, 3.0, seed)), true);
    const auto pattern = std::find_if(
        result.effects.begin(), result.effects.end(), [&](const loop::FoundEffect& effect) {
          return effect.sentence.find("a pattern that repeats every " + std::to_string(every) +
                                      " teeth") != std::string::npos;
        });
    EXPECT_EQ(find(result, "pitch_wave"), nullptr) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    if (pattern == result.effects.end()) continue;
    // Its size is the pattern's standard deviation.
    double mean = 0.0, square = 0.0;
    for (const double um : own) mean += um / every;
    for (const double um : own) square += (um - mean) * (um - mean) / every;
    patterns += std::abs(pattern->terms.front().amplitude() - std::sqrt(square)) < 0.5 ? 1 : 0;
  }
  EXPECT_GE(5 * patterns, 4 * all);
}

// Beside a hollow the size of the part says what the pressure angle does, to the last bit: on
// traces with zeros of their own the usual name is told.
TEST(TeethInTurn, ALeanBesideAHollowIsNoSizeOfThePart) {
  for (const auto& [at, seed] : survey_of(1, {std::pair{0.76, 1U}, {0.85, 6U}})) {
    const MadeGear gear = spur(20);
    const auto made = grown([at = at](auto&, const FlankSpot& s, auto&) {
      return 13.0 * s.u - 13.0 * bell(s.u + at, 0.28);
    });
    InspectionOptions options;
    options.noise_um = 1.5;
    options.points = 50;
    options.seed = seed;
    const auto result = close(gear, inspection_of(gear, {made}, options));
    expect_size(result, "pressure_angle_error", "slope_um", 26.0, 1.5);
    EXPECT_EQ(find(result, "scale"), nullptr) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
