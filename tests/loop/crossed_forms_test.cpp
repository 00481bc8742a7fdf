// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"

// Forms that are the product of two simple courses, over the profile and over the face, and of
// these with one from tooth to tooth: each is one form, told with its place.
namespace trueflank::test {
namespace {

double above(double x, double from) { return std::max(0.0, (x - from) / (1.0 - from)); }
/// 0 ... 1 from root to tip, and from the lower to the upper end.
double up(double coordinate) { return 0.5 * (coordinate + 1.0); }
double centre_rad(const MadeGear& g, const FlankSpot& s) {
  return 2.0 * M_PI * (s.tooth - 1) / g.teeth;
}

void expect_one(const loop::LoopResult& result, const std::vector<std::string>& words) {
  for (const std::string& text : words)
    EXPECT_TRUE(tells(result, text)) << text << "\n" << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_NE(result.verdict, loop::Verdict::kNoEffect) << list(result);
}

loop::LoopResult scanned_with(const MadeGear& gear, const Process& process, unsigned seed,
                              int points = 9000) {
  return close(gear, scan_of(gear, {process}, scanned(points, 1.5, seed)), true);
}

TEST(CrossedForm, OfTheTipAtBothEndsIsOneForm) {
  for (const MadeGear& gear : survey_of(1, {helical(24, 20.0), spur(31)}))
    expect_one(scanned_with(gear, grown([](auto&, const FlankSpot& s, auto&) {
                              return -24.0 * above(up(s.u), 0.5) *
                                     std::exp(-(1.0 - std::abs(s.v)) / 0.24);
                            }),
                            11),
               {"more and more evenly from a diameter of",
                "dying away from both ends of the face within", "there the flanks lie back"});
}

TEST(CrossedForm, LeansAboveAHeightOnly) {
  const MadeGear gear = spur(27);
  expect_one(scanned_with(gear, grown([](auto&, const FlankSpot& s, auto&) {
                            return s.v > 0.1 ? 9.0 * s.u : 0.0;
                          }),
                          12),
             {"the profile leans above a height of", "only: at the tip the flanks stand out"});
}

TEST(CrossedForm, OfOneFlankNamesTheFlank) {
  const MadeGear gear = spur(25);
  const auto result =
      scanned_with(gear, grown([](auto&, const FlankSpot& s, auto&) {
                     const double off = (up(s.u) - 0.4) / 0.15;
                     return s.side > 0 ? -18.0 * std::exp(-off * off) * up(s.v) : 0.0;
                   }),
                   13);
  expect_one(result, {"about a diameter of", "more and more evenly", "towards the upper end"});
  ASSERT_FALSE(result.effects.empty());
  EXPECT_EQ(result.effects[0].flank, "left") << list(result);
}

TEST(CrossedForm, OfOneSideOfTheGearIsOneForm) {
  for (const MadeGear& gear : survey_of(1, {helical(23, -15.0), spur(30)}))
    expect_one(scanned_with(gear, grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                              return 15.0 * std::exp(-up(s.u) / 0.2) *
                                     std::max(0.0, std::cos(centre_rad(g, s) - 2.0));
                            }),
                            14),
               {"on the teeth towards 11", "none on the other half", "dying away from the root"});
}

// A crowning takes up what is alike on all teeth: what is left is more like a wave.
TEST(CrossedForm, OfOneSideStandsBesideABow) {
  const auto result = scanned_with(
      spur(30), grown([](const MadeGear& g, const FlankSpot& s, auto&) {
        return 9.0 * std::exp(-up(s.u) / 0.2) * std::max(0.0, std::cos(centre_rad(g, s) - 2.0)) -
               6.0 * s.v * s.v - 8.0 * s.u * s.u;
      }),
      21);
  EXPECT_TRUE(tells(result, "none on the other half, dying away from the root")) << list(result);
  EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
}

// Waves that march stand beside it: they are no pieces of it.
TEST(CrossedForm, OfSomeTeethStandsBesideWavesWithoutAName) {
  const auto result =
      scanned_with(spur(34), grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                     const bool some = s.tooth >= 20 && s.tooth <= 32;
                     const double march = 13.0 * centre_rad(g, s) - 3.0 * M_PI * s.u;
                     return (some ? -30.0 * above(up(s.u), 0.5) * above(up(s.v), 0.5) : 0.0) +
                            (s.side > 0 ? 9.0 * std::cos(march) : 7.0 * std::cos(march + 1.0));
                   }),
                   22);
  EXPECT_TRUE(tells(result, "on 13 teeth from tooth 20 on, more and more")) << list(result);
}

TEST(CrossedForm, OfTracesOfOneSideIsOneForm) {
  const MadeGear gear = spur(24);
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= 24; ++tooth) teeth.push_back(tooth);
  const auto result =
      close(gear, inspection_of(gear, {grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                                  return -8.0 * up(s.v) * up(s.v) *
                                         std::max(0.0, std::cos(centre_rad(g, s) - 4.0));
                                })},
                                traced(teeth, 1.0, 15)));
  expect_one(result, {"on the teeth towards 2", "none on the other half", "by the square from",
                      "towards the upper end"});
}

TEST(CrossedForm, OfSomeTeethIsOneForm) {
  const MadeGear gear = spur(30);
  expect_one(scanned_with(gear, grown([](auto&, const FlankSpot& s, auto&) {
                            return s.tooth >= 9 && s.tooth <= 17
                                       ? -40.0 * above(up(s.u), 0.4) * above(up(s.v), 0.5)
                                       : 0.0;
                          }),
                          16),
             {"on 9 teeth from tooth 9 on", "towards the tip", "towards the upper end"});
}

TEST(CrossedForm, StandsBesideNames) {
  const MadeGear gear = spur(29);
  const auto form = grown([](auto&, const FlankSpot& s, auto&) {
    return 5.0 * (1.0 - s.v * s.v) -
           24.0 * above(up(s.u), 0.5) * std::exp(-(1.0 - std::abs(s.v)) / 0.24);
  });
  const auto result = scanned_with(gear, form, 17);
  ASSERT_NE(find(result, "crowning"), nullptr) << list(result);
  EXPECT_NEAR(parameter(*find(result, "crowning"), "amount_um").value, 5.0, 0.5) << list(result);
  EXPECT_TRUE(tells(result, "dying away from both ends of the face")) << list(result);
  EXPECT_EQ(result.effects.size(), 3U) << "all flanks stand out by 5 um besides\n" << list(result);
}

TEST(CrossedForm, OfWavesThatGrowWithTheHeightIsOneForm) {
  const auto result = scanned_with(spur(28), grown([](auto&, const FlankSpot& s, auto&) {
                                     return 20.0 * std::cos(2.0 * M_PI * 4.0 * up(s.u)) * up(s.v);
                                   }),
                                   19);
  expect_one(result, {"4.0 waves over the profile", "more and more evenly from the lower end on"});
}

// Three jaws that gripped the lower end; both ends of a flank, and corners, are no other.
TEST(CrossedForm, OfAnOrderThatDiesAwayFromAnEndIsOneForm) {
  const auto jaws = [](double size_um, double phase_rad) {
    return grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
      return size_um * std::cos(3.0 * centre_rad(g, s) - phase_rad) * std::exp(-up(s.v) / 0.3);
    });
  };
  expect_one(scanned_with(spur(37), jaws(30.0, 1.2), 31, 4000),
             {"3 times per turn, dying away from the lower end within 3", "most at 23 deg first"});
  const MadeGear gear = helical(19, 20.0);
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= gear.teeth; ++tooth) teeth.push_back(tooth);
  expect_one(close(gear, inspection_of(gear, {jaws(9.0, -1.0)}, traced(teeth, 0.5, 32))),
             {"3 times per turn, dying away from the lower end within 3", "most at 101 deg first"});
}

TEST(CrossedForm, OfAnOrderAtTheTipIsOppositeBesideAPlainWave) {
  const auto result = scanned_with(
      spur(29), grown([](const MadeGear& g, const FlankSpot& s, auto&) {
        const double from_tip = 1.0 - up(s.u);
        return s.side * 18.0 * std::cos(4.0 * centre_rad(g, s) - 1.0) * std::exp(-from_tip / 0.2) +
               6.0 * std::cos(4.0 * centre_rad(g, s) + 0.4);
      }),
      33, 4000);
  EXPECT_TRUE(tells(result, "4 times per turn, dying away from the tip within")) << list(result);
  EXPECT_TRUE(tells(result, "there the teeth stand counter-clockwise, most at 14 deg first"))
      << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

// A ring that bends as jaws press it moves to the side as well: either flank has its own phase.
TEST(CrossedForm, OfAnOrderMayHaveAPhaseOfEachFlank) {
  const auto result =
      scanned_with(spur(33), grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                     return 24.0 * std::cos(3.0 * centre_rad(g, s) - 0.5 * s.side) *
                            std::exp(-(1.0 - up(s.v)) / 0.25);
                   }),
                   34, 4000);
  EXPECT_TRUE(tells(result, "unnamed left")) << list(result);
  EXPECT_TRUE(tells(result, "unnamed right")) << list(result);
  EXPECT_TRUE(tells(result, "dying away from the upper end within 2.5 mm")) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(CrossedForm, OfAnOrderThatFadesEvenlySaysWhichEndIsGood) {
  expect_one(scanned_with(spur(31), grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                            return 18.0 * std::cos(5.0 * centre_rad(g, s) - 1.0) * (1.0 - up(s.v));
                          }),
                          35, 4000),
             {"5 times per turn, more and more evenly from the upper end on towards the lower end",
              "most at 11 deg first"});
}

TEST(CrossedForm, OfOppositeFlanksIsATwistOfOneEnd) {
  expect_one(scanned_with(spur(30), grown([](auto&, const FlankSpot& s, auto&) {
                            return s.side * 24.0 * s.u * std::pow(std::max(0.0, s.v), 1.5);
                          }),
                          36, 4000),
             {"the profile leans more and more", "towards the upper end, opposite on the two"});
}

// Two names are two names, though their sum may be near a product.
TEST(CrossedForm, IsNotMadeOfNames) {
  const MadeGear gear = spur(26);
  const auto result =
      scanned_with(gear, grown([](auto&, const FlankSpot& s, auto&) {
                     return (s.side > 0 ? 4.0 : -4.0) * s.v - 6.0 * s.v * s.v + 3.0 * s.u * s.v;
                   }),
                   18);
  EXPECT_NE(find(result, "helix_error"), nullptr) << list(result);
  EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
  EXPECT_NE(find(result, "flank_twist"), nullptr) << list(result);
}

}  // namespace
}  // namespace trueflank::test
