// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"

// Bell mouths, bent axes, waves over the profile, hollows and teeth that stand aside: each was told
// as several effects, some with names.
namespace trueflank::test {
namespace {

TEST(BellMouth, AtBothEndsIsNoCrowning) {
  const MadeGear gear = spur(31);
  const auto bell = [](auto&, const FlankSpot& s, auto&) {
    const double v = 0.5 * (s.v + 1.0);
    return -15.0 * (std::exp(-v / 0.1) + std::exp((v - 1.0) / 0.1));
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto result = close(
        gear, inspection_of(gear, {grown(bell)}, traced({1, 5, 9, 13, 17, 21, 24, 28}, 0.8, seed)));
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_NE(list(result).find("more and more over the face towards both ends"), std::string::npos)
        << list(result);
  }
}

TEST(BellMouth, BesideATaperLeavesItItsName) {
  const MadeGear gear = spur(31);
  const auto bell = [](auto&, const FlankSpot& s, auto&) {
    const double v = 0.5 * (s.v + 1.0);
    return -15.0 * (std::exp(-v / 0.1) + std::exp((v - 1.0) / 0.1)) + 6.0 * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto result = close(
        gear, inspection_of(gear, {grown(bell)}, traced({1, 5, 9, 13, 17, 21, 24, 28}, 0.8, seed)));
    ASSERT_NE(find(result, "taper"), nullptr) << list(result);
    EXPECT_NEAR(parameter(*find(result, "taper"), "slope_um").value, 12.0, 0.6) << list(result);
    EXPECT_EQ(find(result, "crowning"), nullptr) << list(result);
  }
}

TEST(BellMouth, ACrowningBesideATaperIsNone) {
  const MadeGear gear = spur(31);
  const auto crowned = [](auto&, const FlankSpot& s, auto&) { return 6.0 * s.v - 9.0 * s.v * s.v; };
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto result =
        close(gear, inspection_of(gear, {grown(crowned)}, traced({1, 9, 17, 24}, 0.8, seed)));
    EXPECT_NE(find(result, "taper"), nullptr) << list(result);
    EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
  }
}

/// Sections moved sideways [um] by a function of the height (-1 ... 1).
template <class Function>
Process moved(Function function, double deg) {
  return {.move_um = [=](const MadeGear&, const FlankSpot& s, const Vec3&) -> Vec3 {
    const double a = deg * M_PI / 180.0, off = function(s.v);
    return {off * std::cos(a), off * std::sin(a), 0.0};
  }};
}

TEST(BentAxis, IsOneFormAndNoEccentricityBesideATilt) {
  struct Bend {
    double (*of)(double v);
    const char* words;
  };
  const Bend bends[] = {
      {[](double v) { return 40.0 * v * v; }, "to both sides of the middle"},
      {[](double v) { return 40.0 * (1.0 - v * v); }, "between its ends"},
      {[](double v) { return 10.0 * (v + 1.0) * (v + 1.0); }, "from the lower end on"},
      {[](double v) { return 10.0 * (v - 1.0) * (v - 1.0); }, "from the upper end on"}};
  for (const MadeGear& gear : {spur(24), helical(27, 12.0)})
    for (const Bend& bend : bends) {
      if (!is_surveyed((gear.helix_rad == 0.0) == ((&bend - bends) % 2 == 0))) continue;
      const auto result =
          close(gear, scan_of(gear, {moved(bend.of, 70.0)}, scanned(8000, 3.0, 2)), true);
      EXPECT_FALSE(has_name(result)) << list(result);
      EXPECT_NE(list(result).find(std::string("the axis of the teeth is bent ") + bend.words),
                std::string::npos)
          << list(result);
    }
}

TEST(BentAxis, BesideAnEccentricityLeavesItItsName) {
  const MadeGear gear = spur(24);
  const auto bent = moved([](double v) { return 40.0 * v * v; }, 70.0);
  const auto off = moved([](double) { return 25.0; }, -40.0);
  const auto result = close(gear, scan_of(gear, {bent, off}, scanned(8000, 3.0, 3)), true);
  ASSERT_NE(find(result, "eccentricity"), nullptr) << list(result);
  EXPECT_NEAR(parameter(*find(result, "eccentricity"), "amplitude_um").value, 25.0, 1.0);
  EXPECT_NE(list(result).find("the axis of the teeth is bent to both sides"), std::string::npos)
      << list(result);
}

TEST(BentAxis, EccentricityTiltAndShiftStayWhatTheyAre) {
  const MadeGear gear = spur(24);
  const auto leans = moved([](double v) { return 20.0 + 20.0 * v; }, 70.0);
  const auto lean = close(gear, scan_of(gear, {leans}, scanned(8000, 3.0, 4)), true);
  EXPECT_NE(find(lean, "eccentricity"), nullptr) << list(lean);
  EXPECT_NE(find(lean, "axis_tilt"), nullptr) << list(lean);
  const auto shifts = moved([](double v) { return v > 0.2 ? 30.0 : 0.0; }, 70.0);
  const auto shift = close(gear, scan_of(gear, {shifts}, scanned(8000, 3.0, 5)), true);
  EXPECT_NE(find(shift, "layer_shift"), nullptr) << list(shift);
}

TEST(WaveOverTheProfile, OnFourTeethIsNoGhostOrder) {
  const MadeGear gear = spur(21);
  for (const double phase : {0.0, 1.5, 3.0, 4.5})
    for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
      const auto wave = [=](auto&, const FlankSpot& s, auto&) {
        return 5.0 * std::cos(1.5 * M_PI * (s.u + 1.0) + phase);
      };
      const auto result =
          close(gear, inspection_of(gear, {grown(wave)}, traced({1, 6, 12, 17}, 0.6, seed)));
      EXPECT_FALSE(has_name(result)) << list(result);
      EXPECT_NE(list(result).find("waves over the profile"), std::string::npos) << list(result);
      EXPECT_EQ(list(result).find("machine's"), std::string::npos) << list(result);
    }
}

TEST(WaveOverTheProfile, AGhostOrderOfAllTeethStays) {
  const MadeGear gear = spur(21);
  const auto ghost = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
    const double roll = from + 0.5 * (s.u + 1.0) * (to - from);
    const double rotation = 2.0 * M_PI * (s.tooth - 1) / g.teeth - s.side * roll / g.base();
    return 4.0 * std::cos(33.0 * rotation);
  };
  InspectionOptions options = traced({}, 0.6, 1);
  const auto result = close(gear, inspection_of(gear, {grown(ghost)}, options));
  ASSERT_NE(find(result, "ghost_order"), nullptr) << list(result);
  EXPECT_EQ(parameter(*find(result, "ghost_order"), "order").value, 33.0);
}

TEST(WaveOverTheProfile, FlatsOfAHobHaveAMeanThatIsNoOffsetOfTheWalls) {
  const MadeGear gear = spur(42);
  const auto flats = [](auto&, const FlankSpot& s, auto&) {
    return 18.0 * std::abs(std::sin(M_PI * (2.5 * (s.u + 1.0) + 0.3)));
  };
  const auto result = close(gear, scan_of(gear, {grown(flats)}, scanned(14000, 4.0, 1)), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  EXPECT_NE(list(result).find("waves over the profile"), std::string::npos) << list(result);
}

TEST(WaveOverTheProfile, FeedMarksLeaveAnOffsetItsName) {
  const MadeGear gear = spur(42);
  const auto marks = [](auto&, const FlankSpot& s, auto&) {
    return 18.0 + 6.0 * std::sin(M_PI * 5.0 * (s.u + 1.0));
  };
  const auto result = close(gear, scan_of(gear, {grown(marks)}, scanned(14000, 4.0, 1)), true);
  EXPECT_TRUE(has_name(result)) << list(result);
}

TEST(AnS, BesideASlopeIsNoWearOfFourTeeth) {
  // Of 40 draws these were a wear beside a ghost order, or a wear that left what a small relief had
  // said beside it.
  const MadeGear gear = spur(15);
  for (const unsigned seed : survey_of(3, {1U, 2U, 12U, 14U, 15U, 20U, 31U})) {
    const double a = 1.0 + 0.05 * seed;
    const auto bent = [=](auto&, const FlankSpot& s, auto&) {
      return 1.7 * a * std::sin(M_PI * s.u) + 1.25 * a * s.u;
    };
    InspectionOptions options = traced({1, 5, 9, 12}, 0.42, seed);
    options.correlation = 0.5;
    const auto result = close(gear, inspection_of(gear, {grown(bent)}, options));
    EXPECT_EQ(find(result, "flank_wear"), nullptr) << list(result);
    EXPECT_EQ(find(result, "ghost_order"), nullptr) << list(result);
  }
}

TEST(BowOncePerTurn, OfEightTeethIsFoundBesideACrowning) {
  const MadeGear gear = spur(24);
  for (unsigned seed = 1; seed <= survey_size(1U, 4U); ++seed) {
    const auto quenched = [=](const MadeGear& g, const FlankSpot& s, auto&) {
      return s.v * s.v * (16.0 * std::cos(2.0 * M_PI * (s.tooth - 1) / g.teeth - seed) - 13.0);
    };
    const auto result = close(
        gear,
        inspection_of(gear, {grown(quenched)}, traced({1, 4, 7, 10, 13, 16, 19, 22}, 1.6, seed)));
    EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
    EXPECT_NE(list(result).find("once per turn, crowned over the face"),
              std::string::npos)
        << list(result);
  }
}

TEST(BowOncePerTurn, IsNotToldOfTeethThatDifferByChance) {
  const MadeGear gear = spur(24);
  unsigned waves = 0;
  const unsigned all = survey_size(4U, 12U);
  for (unsigned seed = 1; seed <= all; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> own;
    for (int tooth = 0; tooth <= gear.teeth; ++tooth) own.push_back(12.0 * normal(random));
    const auto bowed = [&](auto&, const FlankSpot& s, auto&) {
      return own[static_cast<std::size_t>(s.tooth)] * s.v * s.v;
    };
    const auto result = close(
        gear,
        inspection_of(gear, {grown(bowed)}, traced({1, 4, 7, 10, 13, 16, 19, 22}, 1.6, seed)));
    waves += list(result).find("per turn, crowned") != std::string::npos;
  }
  EXPECT_LE(12 * waves, all);
}

TEST(HollowOfEveryFlank, InLittleNoiseIsNoSumOfWavesAcrossTheFlanks) {
  MadeGear gear = spur(42);
  const auto sunk = [](auto&, const FlankSpot& s, auto&) {
    return -3.5 * std::exp(-s.u * s.u / 0.25 - s.v * s.v / 0.16);
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result = close(gear, scan_of(gear, {grown(sunk)}, scanned(8000, 0.44, seed)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NE(list(result).find("a hollow of the flank at a diameter of"),
              std::string::npos)
        << list(result);
  }
}

TEST(TeethAside, TwoThatHideEachOtherAreFoundAndNoWaveIs) {
  const MadeGear gear = spur(21);
  for (const int other : survey_of(1, {6, 7, 13})) {
    const auto moved_teeth = [=](auto&, const FlankSpot& s, auto&) {
      return 40.0 * s.side * ((s.tooth == 5 ? 1.0 : 0.0) - (s.tooth == other ? 1.0 : 0.0));
    };
    const auto result =
        close(gear, scan_of(gear, {grown(moved_teeth)}, scanned(8000, 3.5, 1)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
    for (const int tooth : {5, other})
      EXPECT_NE(list(result).find("tooth " + std::to_string(tooth) + " stands aside"),
                std::string::npos)
          << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(TeethAside, OneOfAnIndexIsOneEffectAndNotTwo) {
  const MadeGear gear = spur(27);
  const auto moved_tooth = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 9 ? 8.0 * s.side : 0.0;
  };
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.4;
  const auto result = close(gear, inspection_of(gear, {grown(moved_tooth)}, options));
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_NE(list(result).find("tooth 9 stands aside"), std::string::npos) << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amount_um").value, 8.0, 1.2);
}

TEST(TeethAside, ThickTeethKeepTheirName) {
  const MadeGear gear = spur(27);
  const auto thick = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 9 || s.tooth == 20 ? 30.0 : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(thick)}, scanned(8000, 3.5, 1)), true);
  int single = 0;
  for (const auto& effect : result.effects) single += effect.id == "single_tooth" ? 1 : 0;
  EXPECT_EQ(single, 2) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(TeethAside, WhatTheToothBesideLeavesHasNoName) {
  // A slit ring: one tooth stands aside, and the next a little out.
  const MadeGear gear = spur(27);
  const auto slit = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 9 ? 30.0 * s.side : s.tooth == 10 ? 8.0 : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(slit)}, scanned(8000, 2.0, 1)), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  EXPECT_NE(list(result).find("tooth 9 stands aside"), std::string::npos) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(NamesBesideForms, ATaperBesideAnEndReliefKeepsItsName) {
  const MadeGear gear = spur(14);
  for (const double end : {-1.0, 1.0})
    for (const double amount : survey_of(1, {-9.0, 9.0}))
      for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
        const auto relieved = [=](auto&, const FlankSpot& s, auto&) {
          return -4.5 * s.v + amount * std::max(0.0, end * s.v - 0.6) / 0.4;
        };
        const auto result =
            close(gear, scan_of(gear, {grown(relieved)}, scanned(8000, 0.85, seed)), true);
        ASSERT_NE(find(result, "taper"), nullptr) << list(result);
        EXPECT_NEAR(parameter(*find(result, "taper"), "slope_um").value, -9.0, 0.6) << list(result);
        EXPECT_NE(list(result).find("a kink over the face"), std::string::npos) << list(result);
        EXPECT_NE(list(result).find(end < 0.0 ? "towards the lower end" : "towards the upper end"),
                  std::string::npos)
            << list(result);
      }
}

TEST(NamesBesideForms, AReliefBesideASlopeKeepsItsName) {
  // Of a slope that comes three times per turn these three teeth show one of opposite flanks.
  const MadeGear gear = spur(63);
  const auto relieved = [](auto&, const FlankSpot& s, auto&) {
    return 2.6 * s.side * s.u - 6.0 * std::pow(std::max(0.0, s.u - 0.4) / 0.6, 2);
  };
  InspectionOptions options = traced({1, 22, 43}, 0.42, 1);
  for (options.seed = 1; options.seed <= survey_size(1U, 3U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(relieved)}, options));
    const auto* relief = find(result, "tip_relief");
    ASSERT_NE(relief, nullptr) << list(result);
    EXPECT_EQ(relief->flank, "both") << list(result);
    EXPECT_NEAR(parameter(*relief, "amount_um").value, 6.0, 0.5) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
