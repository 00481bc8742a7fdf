// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/loop/one_drawn_form.h"

// One cause each that was told in two pieces or with a false name: what comes and goes between
// nothing and all, turns with the height, drifts or jumps around the body, or slips and stays.
namespace trueflank::test {
namespace {

constexpr double kPiOfForms = std::numbers::pi;

Draw come_and_go_draw(unsigned seed) { return Draw(seed * 6151U + 29U); }

double direction_of_tooth(const MadeGear& gear, const FlankSpot& s) {
  return 2.0 * kPiOfForms * (s.tooth - 1) / gear.teeth;
}

/// Points moved outwards by an amount [um] of their direction [rad] and place along the face.
template <class Amount>
Process moved_by_radius(Amount amount) {
  return {.move_um = [amount](const MadeGear&, const FlankSpot& s, const Vec3& p) -> Vec3 {
    const double radius = std::hypot(p[0], p[1]), angle = std::atan2(p[1], p[0]);
    const double out = amount(angle < 0.0 ? angle + 2.0 * kPiOfForms : angle, s);
    return {out * p[0] / radius, out * p[1] / radius, 0.0};
  }};
}

/// Traces of one kind on some teeth, in a noise that is drawn.
enum class Traced { kProfilesAlone, kHelicesAlone };
loop::LoopResult traced_with(const MadeGear& gear, const Process& made, Traced kind,
                             const std::vector<int>& teeth, double noise_um, unsigned seed) {
  InspectionOptions options = traced(teeth, noise_um, seed);
  (kind == Traced::kProfilesAlone ? options.helix : options.profile) = false;
  return close(gear, inspection_of(gear, {made}, options));
}
loop::LoopResult index_of_made(const MadeGear& gear, const Process& made, double noise_um,
                               unsigned seed) {
  InspectionOptions options = traced({}, noise_um, seed);
  options.profile = options.helix = false;
  options.index = true;
  return close(gear, inspection_of(gear, {made}, options));
}

void expect_one_nameless(const loop::LoopResult& result, double um, double within,
                         const std::string& words) {
  expect_one_of_size(result, um, within);
  EXPECT_FALSE(has_name(result)) << list(result);
  EXPECT_TRUE(tells(result, words)) << list(result);
}

// Beside feed marks of one side, which are found first.
TEST(Roofs, AreNoSlopeBesideAKink) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(25);
    const double um = draw.between(7.0, 10.0), at = draw.between(-0.1, 0.2),
                 marks = draw.between(9.0, 13.0), period = draw.between(5.0, 7.0);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return um * std::abs(s.u - at) / (1.0 + std::abs(at)) +
             (s.side > 0 ? marks * std::cos(kPiOfForms * period * s.v) : 0.0);
    });
    const auto result = close(
        gear,
        inspection_of(gear, {made}, traced({3, 8, 13, 18, 23}, draw.between(0.7, 1.0), seed)));
    EXPECT_EQ(find(result, "pressure_angle_error"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "straight on in another direction to both sides")) << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

// Pressed from both sides: lowest at a height off the middle, as much out at both ends. The mean of
// it is no thicker tooth, and the two slopes are no taper.
TEST(WaistOfTheFlanks, IsOneFormAndNoThicknessTaperAndKink) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(19, 28));
    const double um = draw.between(30.0, 70.0),
                 at = (seed % 2 == 0 ? -1.0 : 1.0) * draw.between(0.2, 0.45);
    const auto waist = grown([=](auto&, const FlankSpot& s, auto&) {
      return um * (s.v < at ? (at - s.v) / (at + 1.0) : (s.v - at) / (1.0 - at));
    });
    ScanOptions options = scanned(6000, 4.0, seed);
    options.any_pose = seed % 2 == 0;
    const auto result = close(gear, scan_of(gear, {waist}, options), !options.any_pose);
    EXPECT_FALSE(has_name(result)) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "from there straight to both ends")) << list(result);
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, um, 1.5) << list(result);
  }
}

TEST(WaistOfTheFlanks, LeavesASlopeBesideItWhatItIs) {
  const MadeGear gear = spur(22);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) {
    return 50.0 * (s.v < 0.3 ? (0.3 - s.v) / 1.3 : (s.v - 0.3) / 0.7) + 14.0 * s.v;
  });
  const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 5.0, 3)), true);
  ASSERT_EQ(result.effects.size(), 2U) << list(result);
  EXPECT_TRUE(tells(result, "from there straight to both ends")) << list(result);
  EXPECT_TRUE(tells(result, "the teeth grow thicker with height")) << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 28.0, 2.0) << list(result);
}

TEST(SpokesOfARim, AreSoManyHollowsAboutAHeight) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(20, 30));
    const int number = draw.whole(3, 6);
    const double um = draw.between(45.0, 70.0), half = draw.between(0.35, 0.5),
                 at = draw.between(-0.2, 0.2), from = draw.between(0.0, 6.0);
    const auto pulled = moved_by_radius([=](double angle, const FlankSpot& s) {
      return -um * std::pow(std::cos(0.5 * number * (angle - from)), 2) * bell_of(s.v - at, half);
    });
    expect_one_nameless(close(gear, scan_of(gear, {pulled}, scanned(5500, 5.0, seed)), true), um,
                        0.1, std::to_string(number) + " hollows of the body evenly spaced");
  }
}

TEST(WavesThatComeAndGo, AreOneWaveAroundTheGear) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(30, 44));
    const double um = draw.between(5.0, 9.0), waves = draw.between(6.0, 10.0),
                 from = draw.between(0.0, 6.0);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      return um * 0.5 * (1.0 + std::cos(direction_of_tooth(g, s) - from)) *
             std::cos(kPiOfForms * waves * s.v);
    });
    expect_one_nameless(
        traced_with(gear, made, Traced::kHelicesAlone, {1, 3, 6, 8, 11, 14, 17, 19, 22, 25, 27, 29},
                    draw.between(0.5, 0.8), seed),
        um, 0.1, "coming and going once per turn");
  }
}

TEST(CrossHatch, IsOfBothFlanks) {
  for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(13, 17));
    const double um = draw.between(35.0, 50.0), along = draw.between(1.8, 2.6),
                 over = draw.between(3.0, 4.2);
    const auto honed = grown([&](auto&, const FlankSpot& s, auto&) {
      return um * std::cos(kPiOfForms * (along * s.u + over * s.v)) +
             um * std::cos(kPiOfForms * (along * s.u - over * s.v) - 1.0);
    });
    const auto result = close(gear, scan_of(gear, {honed}, scanned(8500, 4.0, seed)), true);
    for (const auto& effect : result.effects) EXPECT_EQ(effect.flank, "both") << list(result);
    EXPECT_FALSE(has_name(result)) << list(result);
  }
}

TEST(TwistedOval, IsOneWaveThatTurnsWithTheHeight) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(24, 34));
    const int order = draw.whole(2, 3);
    const double um = draw.between(30.0, 45.0), turns = draw.sign() * draw.between(1.2, 2.6),
                 from = draw.between(0.0, 6.0);
    const auto twisted = moved_by_radius([=](double angle, const FlankSpot& s) {
      return um * std::cos(order * angle - from - turns * 0.5 * (s.v + 1.0));
    });
    expect_one_nameless(close(gear, scan_of(gear, {twisted}, scanned(5500, 5.0, seed)), true), um,
                        0.05, std::string("turning with the height"));
  }
}

TEST(ViewsEachMoved, AreViewsAndNoLobes) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(24, 36));
    const int views = draw.whole(4, 7);
    const double from = draw.between(0.0, 6.2);
    std::vector<double> um;
    for (int view = 0; view < views; ++view)
      um.push_back((view % 2 == 0 ? 1.0 : -1.0) * draw.between(10.0, 40.0));
    const auto shifted = moved_by_radius([=](double angle, const FlankSpot&) {
      const double turns = (angle - from) / (2.0 * kPiOfForms);
      return um[static_cast<std::size_t>((turns - std::floor(turns)) * views)];
    });
    const auto result = close(gear, scan_of(gear, {shifted}, scanned(5500, 4.0, seed)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_TRUE(tells(result, std::to_string(views) + " views of a scan")) << list(result);
    EXPECT_LT(result.effects.size(), 3U) << list(result);
  }
}

TEST(SpiralScan, IsADriftOfTheRadiusAndNoScale) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(24, 40));
    const double um = draw.between(45.0, 70.0), from = draw.between(0.0, 6.2), sign = draw.sign();
    const auto warmed = moved_by_radius([=](double angle, const FlankSpot&) {
      const double turns = (angle - from) / (2.0 * kPiOfForms);
      return sign * um * (turns - std::floor(turns));
    });
    const auto result = close(gear, scan_of(gear, {warmed}, scanned(5500, 5.0, seed)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_TRUE(tells(result, sign > 0.0 ? "the radius grows evenly" : "the radius shrinks evenly"))
        << list(result);
    EXPECT_LT(result.effects.size(), 3U) << list(result);
  }
}

TEST(SectionsThatTurn, ByABendAreNoStepAndNoSlopeWithAName) {
  for (unsigned seed = 1; seed <= survey_size(3U, 12U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(19, 43));
    const double um = draw.sign() * draw.between(6.0, 14.0), at = draw.between(-0.5, 0.4);
    const bool upper = draw.whole(0, 1) == 1;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      const double off = (upper ? s.v : -s.v) - at;
      return off > 0.0 ? s.side * um * std::pow(off / (1.0 - at), 2) : 0.0;
    });
    expect_one_nameless(traced_with(gear, made, Traced::kHelicesAlone, {2, 6, 10, 14, 18},
                                    draw.between(0.6, 1.0), seed),
                        std::abs(um), 0.15, "and curved from there on");
  }
}

TEST(SectionsThatTurn, InAWaveAreSeldomToldInPiecesThatUndoEachOther) {
  const unsigned gears = survey_size(3U, 12U);
  unsigned told = 0;
  for (unsigned seed = 1; seed <= gears; ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(19, 43));
    const double um = draw.between(5.0, 12.0), waves = draw.between(0.8, 1.3),
                 phase = draw.whole(0, 1) * draw.between(0.0, 6.28);
    const bool face = draw.whole(0, 1) == 1;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side * um * std::sin(kPiOfForms * waves * (face ? s.v : s.u) + phase);
    });
    const auto result =
        traced_with(gear, made, face ? Traced::kHelicesAlone : Traced::kProfilesAlone,
                    {2, 6, 10, 14, 18}, draw.between(0.6, 1.0), seed);
    EXPECT_FALSE(has_name(result)) << list(result);
    if (result.effects.size() != 1 || !tells(result, "opposite on the two flanks")) continue;
    EXPECT_NEAR(amplitude_of_first(result), um, 0.12 * um) << list(result);
    if (tells(result, face ? "waves over the face" : "waves over the profile")) ++told;
  }
  EXPECT_GE(12 * told, 11 * gears);
}

TEST(SlipsOfTheDrive, RiseOverSomeTeethAndStay) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(36, 56));
    const int first = draw.whole(6, 12), over = draw.whole(6, 11);
    const double um = draw.between(4.0, 7.0), sign = draw.sign();
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side * sign * um * std::clamp((s.tooth - first) / double(over), 0.0, 1.0);
    });
    expect_one_nameless(index_of_made(gear, made, draw.between(0.3, 0.5), seed), um, 0.12,
                        "and stays so up to tooth " + std::to_string(gear.teeth));
  }
}

TEST(SlitsOfARing, SpringApartAndDieAwayToBothSides) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(36, 64));
    const int before = draw.whole(2, gear.teeth - 2);
    const double um = draw.between(4.0, 7.0), sign = draw.sign(), within = draw.between(1.8, 4.0);
    const auto sprung = grown([&](auto&, const FlankSpot& s, auto&) {
      const double off = std::remainder(s.tooth - before - 0.5, gear.teeth);
      return s.side * sign * um * std::copysign(std::exp(-(std::abs(off) - 0.5) / within), off);
    });
    expect_one_nameless(index_of_made(gear, sprung, draw.between(0.25, 0.4), seed), um, 0.15,
                        "between tooth " + std::to_string(before) + " and tooth " +
                            std::to_string(before + 1) + ", the teeth stand " +
                            (sign > 0.0 ? "apart" : "closer"));
  }
}

TEST(ArchesOfAnIndex, GoOnceAroundAndClose) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(40, 70));
    const double um = draw.between(3.0, 6.0), sign = draw.sign();
    const int first = draw.whole(1, gear.teeth);
    const auto drifted = grown([&](auto&, const FlankSpot& s, auto&) {
      const double share = double((s.tooth - first + gear.teeth) % gear.teeth) / gear.teeth;
      return s.side * sign * um * 4.0 * share * (1.0 - share);
    });
    const auto result = index_of_made(gear, drifted, draw.between(0.2, 0.3), seed);
    expect_one_nameless(result, um, 0.1, "once around in one arch");
    EXPECT_TRUE(tells(
        result, sign > 0.0 ? "the teeth stand counter-clockwise" : "the teeth stand clockwise"))
        << list(result);
  }
}

TEST(BurstsOfADrive, AreNoKnockAtOneSide) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(50, 70));
    const double um = draw.between(3.0, 6.0), half = draw.between(5.0, 8.0);
    const int about = draw.whole(1, gear.teeth), waves = draw.whole(8, 12);
    const auto rattled = grown([&](auto&, const FlankSpot& s, auto&) {
      const double off = std::remainder(s.tooth - about, gear.teeth);
      return s.side * um * std::cos(2.0 * kPiOfForms * waves * (s.tooth - 1) / gear.teeth) *
             bell_of(off, half);
    });
    expect_one_nameless(index_of_made(gear, rattled, draw.between(0.25, 0.4), seed), um, 0.2,
                        " in a burst, ");
  }
}

// From any tooth on, shorter or longer, beside an eccentricity in every other draw.
TEST(StretchingWaves, OfAnIndexAreOneFormAndNotOneForEveryOrder) {
  for (unsigned seed = 1; seed <= survey_size(3U, 12U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(45, 70));
    const double um = draw.between(2.5, 6.0), noise = draw.between(0.25, 0.5),
                 few = draw.between(3.0, 5.5), more = draw.between(5.0, 8.0),
                 phase = draw.between(0.0, 6.28);
    const int from = draw.whole(1, gear.teeth);
    const double at_first = seed % 3 == 0 ? few + more : few, change = seed % 3 == 0 ? -more : more;
    const auto stretched = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      const double share = double((s.tooth - from + g.teeth) % g.teeth) / g.teeth;
      const double off = seed % 2 == 0 ? 5.0 * std::cos(direction_of_tooth(g, s) - 1.0) : 0.0;
      return s.side *
             (um * std::cos(2.0 * kPiOfForms * (at_first * share + 0.5 * change * share * share) -
                            phase) +
              off);
    });
    const auto result = index_of_made(gear, stretched, noise, seed);
    EXPECT_EQ(result.effects.size(), seed % 2 == 0 ? 2U : 1U) << seed << list(result);
    const auto wave =
        std::find_if(result.effects.begin(), result.effects.end(), [](const auto& effect) {
          return effect.description.find("in waves that get evenly") != std::string::npos;
        });
    ASSERT_NE(wave, result.effects.end()) << seed << list(result);
    EXPECT_NEAR(parameter(*wave, "amplitude_um").value, um, 0.2 * um) << seed << list(result);
    EXPECT_NEAR(wave->terms.front().shape[0], at_first, 0.5) << seed << list(result);
    EXPECT_NEAR(wave->terms.front().shape[1], at_first + change, 0.6) << seed << list(result);
  }
}

TEST(StretchingWaves, AreNoneOfWavesOfOneLengthAndOfNoise) {
  for (unsigned seed = 1; seed <= survey_size(4U, 24U); ++seed) {
    Draw draw = come_and_go_draw(100 + seed);
    const MadeGear gear = spur(draw.whole(30, 70));
    const double um = seed % 2 == 0 ? draw.between(2.0, 5.0) : 0.0;
    const int waves = draw.whole(3, 9);
    const auto made = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      return s.side * um * std::cos(waves * direction_of_tooth(g, s));
    });
    const auto result = index_of_made(gear, made, draw.between(0.25, 0.6), seed);
    EXPECT_FALSE(tells(result, "get evenly")) << seed << list(result);
  }
}

TEST(FormsThatGrowAnew, AreOneFormFromNothing) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const int every = draw.whole(6, 10);
    const MadeGear gear = spur(every * draw.whole(3, 5));
    const double um = draw.sign() * draw.between(5.0, 10.0);
    const int first = draw.whole(1, every);
    const auto worn = grown([&](auto&, const FlankSpot& s, auto&) {
      const double u = 0.5 * (1.0 + s.u);
      return um * ((s.tooth - first + every) % every) / (every - 1.0) * u * u;
    });
    std::vector<int> teeth;
    for (int tooth = 1; tooth <= gear.teeth; ++tooth) teeth.push_back(tooth);
    expect_one_nameless(
        traced_with(gear, worn, Traced::kProfilesAlone, teeth, draw.between(0.5, 0.8), seed),
        std::abs(um), 0.15, "from tooth to tooth, and anew every " + std::to_string(every));
  }
}

TEST(BurstsOfChatter, AreWavesAboutAPlace) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(22, 38));
    const double um = draw.between(7.0, 13.0), waves = draw.between(9.0, 12.0),
                 at = draw.between(-0.3, 0.3), half = draw.between(0.22, 0.34);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return um * bell_of(s.v - at, half) * std::cos(kPiOfForms * waves * s.v);
    });
    expect_one_nameless(traced_with(gear, made, Traced::kHelicesAlone, {2, 7, 12, 17, 21},
                                    draw.between(0.7, 1.1), seed),
                        um, 0.12, "in a burst at");
  }
}

// Draws (of 80) whose first answer is a groove at the first or last point.
TEST(EndReliefs, AreNoGrooveAtTheFirstPoint) {
  constexpr std::array<unsigned, 5> kSeeds{2, 6, 5, 40, 72};
  for (std::size_t k = 0; k < survey_size(std::size_t{2}, kSeeds.size()); ++k) {
    Draw draw = come_and_go_draw(kSeeds.at(k));
    const MadeGear gear = spur(draw.whole(22, 38));
    const double um = draw.between(2.5, 4.0), over = draw.between(0.25, 0.45);
    const bool upper = draw.whole(0, 1) == 1;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side > 0 ? -um * std::max(over - 1.0 + (upper ? s.v : -s.v), 0.0) / over : 0.0;
    });
    const auto result = traced_with(gear, made, Traced::kHelicesAlone, {2, 7, 12, 17, 21},
                                    draw.between(0.4, 0.7), kSeeds.at(k));
    EXPECT_FALSE(tells(result, "a groove")) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
  }
}

TEST(CombsOfEitherFlank, AreNotToldInHalvesOfBoth) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(60);
    const int first = draw.whole(1, 3), second = draw.whole(1, 5);
    const double um = draw.between(5.0, 9.0);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      if (s.side > 0) return (s.tooth - first) % 3 == 0 ? um : 0.0;
      return (s.tooth - second) % 5 == 0 ? -0.8 * um : 0.0;
    });
    const auto result = index_of_made(gear, made, 0.5, seed);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    ASSERT_EQ(result.effects.size(), 2U) << list(result);
    for (const auto& effect : result.effects) EXPECT_NE(effect.flank, "both") << list(result);
  }
}

TEST(RidgesThatComeAndGo, AreNoRidgeBesideWaves) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = come_and_go_draw(seed);
    const MadeGear gear = spur(draw.whole(14, 20));
    const double um = draw.between(35.0, 55.0), at = draw.between(-0.2, 0.3),
                 waves = draw.between(2.6, 4.2), from = draw.between(0.0, 6.0),
                 sign = seed % 2 == 0 ? 1.0 : -1.0;  // (a hollow is half a wear)
    const auto cut = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side > 0 ? sign * um * bell_of(s.u - at, 0.22) *
                              std::pow(std::cos(0.5 * kPiOfForms * waves * s.v - from), 2)
                        : 0.0;
    });
    expect_one_nameless(close(gear, scan_of(gear, {cut}, scanned(9000, 5.0, seed)), true), um, 0.12,
                        "coming and going, every ");
  }
}

}  // namespace
}  // namespace trueflank::test
