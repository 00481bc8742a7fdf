// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/loop/made_gears.h"

// Names that stand beside one form: an S or a bow that is opposite on the two flanks, a form that
// is equal on both beside a slope that is not, a groove or a ridge that some teeth have.
namespace trueflank::test {
namespace {

bool tells(const loop::LoopResult& result, const std::string& words) {
  return list(result).find(words) != std::string::npos;
}

TEST(OppositeForms, LeaveAHelixErrorItsName) {
  const auto leaning_s = [](auto&, const FlankSpot& s, auto&) {
    return s.side * (7.5 * s.v - 20.0 * (s.v * s.v * s.v - 0.6 * s.v));
  };
  const auto leaning_bow = [](auto&, const FlankSpot& s, auto&) {
    return s.side * (4.0 * s.v + 10.0 * s.v * s.v);
  };
  for (const MadeGear& gear : {spur(17), helical(17, -24.0)}) {
    const auto traced_s =
        close(gear, inspection_of(gear, {grown(leaning_s)}, traced({1, 4, 7, 10, 13, 16}, 1.8, 1)));
    ASSERT_NE(find(traced_s, "helix_error"), nullptr) << list(traced_s);
    EXPECT_TRUE(tells(traced_s, "S-shaped over the face, opposite")) << list(traced_s);
    const auto scanned_bow =
        close(gear, scan_of(gear, {grown(leaning_bow)}, scanned(6000, 1.5, 2)), true);
    ASSERT_NE(find(scanned_bow, "helix_error"), nullptr) << list(scanned_bow);
    EXPECT_NEAR(std::abs(parameter(*find(scanned_bow, "helix_error"), "slope_um").value), 8.0, 0.4)
        << list(scanned_bow);
    EXPECT_TRUE(tells(scanned_bow, "crowned over the face, opposite")) << list(scanned_bow);
  }
}

TEST(OppositeForms, ThatOneKinkSaysWithTheirSlopeLeaveItNone) {
  const MadeGear gear = spur(24);
  const auto kinked = [](auto&, const FlankSpot& s, auto&) {
    return s.side * 12.0 * std::max(s.v - 0.1, 0.0);
  };
  const auto bent = [](auto&, const FlankSpot& s, auto&) {
    return s.side * 12.0 * std::pow(std::max(s.v + 0.4, 0.0), 2);
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const InspectionOptions options = traced({1, 7, 13, 19}, 1.2, seed);
    const auto kink = close(gear, inspection_of(gear, {grown(kinked)}, options));
    EXPECT_FALSE(has_name(kink)) << list(kink);
    const auto bend = close(gear, inspection_of(gear, {grown(bent)}, options));
    EXPECT_FALSE(has_name(bend)) << list(bend);
  }
}

TEST(EqualForms, LeaveAHelixErrorItsName) {
  const MadeGear gear = spur(31);
  const auto bent = [](auto&, const FlankSpot& s, auto&) {
    return 18.0 * (s.v * s.v * s.v - 0.6 * s.v) - 4.0 * s.v * s.v + 5.0 * s.side * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto result = close(
        gear, inspection_of(gear, {grown(bent)}, traced({1, 5, 9, 13, 17, 21, 25, 28}, 1.0, seed)));
    ASSERT_NE(find(result, "helix_error"), nullptr) << list(result);
    EXPECT_NEAR(std::abs(parameter(*find(result, "helix_error"), "slope_um").value), 10.0, 0.5)
        << list(result);
  }
}

/// Worn at an end of the right flanks, or S-shaped over the profile of the left ones.
double worn_um(const FlankSpot& s) {
  return s.side < 0 ? -14.0 * std::exp((s.v - 1.0) / 0.3) : 0.0;
}
double s_shaped_um(const FlankSpot& s) {
  return s.side > 0 ? 14.0 * (s.u * s.u * s.u - 0.6 * s.u) : 0.0;
}
double relief_um(const FlankSpot& s) { return -12.0 * std::pow(std::max(s.u - 0.3, 0.0) / 0.7, 2); }

TEST(FormsOfOneFlank, LeaveWhatTheOtherFlankShowsItsName) {
  const MadeGear gear = spur(20);
  const auto worn = [](auto&, const FlankSpot& s, auto&) { return worn_um(s) - 5.0 * s.v * s.v; };
  const auto bent = [](auto&, const FlankSpot& s, auto&) { return s_shaped_um(s) + relief_um(s); };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const InspectionOptions options = traced({1, 6, 11, 16}, 0.8, seed);
    const auto lines = close(gear, inspection_of(gear, {grown(worn)}, options));
    const auto cloud = close(gear, scan_of(gear, {grown(worn)}, scanned(8000, 1.2, seed)), true);
    for (const loop::LoopResult* result : {&lines, &cloud}) {
      ASSERT_NE(find(*result, "crowning"), nullptr) << list(*result);
      expect_size(*result, "crowning", "amount_um", 5.0, 0.35);
      EXPECT_EQ(find(*result, "crowning")->flank, "both") << list(*result);
      EXPECT_TRUE(tells(*result, "towards the upper end, within")) << list(*result);
    }
    const auto profile = close(gear, inspection_of(gear, {grown(bent)}, options));
    ASSERT_NE(find(profile, "tip_relief"), nullptr) << list(profile);
    expect_size(profile, "tip_relief", "amount_um", 12.0, 1.0);
    EXPECT_EQ(find(profile, "tip_relief")->flank, "both") << list(profile);
  }
}

TEST(FormsOfOneFlank, LeaveNoNameThatTheOtherFlankDoesNotShow) {
  const MadeGear gear = spur(26);
  const auto worn = [](auto&, const FlankSpot& s, auto&) { return worn_um(s); };
  const auto bent = [](auto&, const FlankSpot& s, auto&) { return s_shaped_um(s); };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed)
    for (const Process& process : {grown(worn), grown(bent)}) {
      const auto result =
          close(gear, inspection_of(gear, {process}, traced({1, 8, 14, 20}, 0.8, seed)));
      EXPECT_FALSE(has_name(result)) << list(result);
    }
}

TEST(SectorsThatLean, LeaveATaperItsName) {
  const MadeGear gear = spur(28);
  const auto leaning = [](auto&, const FlankSpot& s, auto&) {
    return -6.0 * s.v + (s.tooth >= 9 && s.tooth <= 16 ? 7.0 * s.side * s.v : 0.0);
  };
  const auto result = close(gear, inspection_of(gear, {grown(leaning)}, traced({}, 1.0, 1)));
  expect_size(result, "taper", "slope_um", -12.0, 0.6);
  EXPECT_TRUE(tells(result, "a sector of 8 teeth from tooth 9 on leans")) << list(result);
}

TEST(HeightsThatChange, LeaveAReliefItsName) {
  const MadeGear gear = spur(34);
  const auto warming = [](auto&, const FlankSpot& s, auto&) {
    return relief_um(s) + 22.0 * (1.0 - std::exp(-(s.tooth - 1) / 6.0));
  };
  const auto result = close(gear, scan_of(gear, {grown(warming)}, scanned(9000, 1.5, 1)), true);
  expect_size(result, "tip_relief", "amount_um", 12.0, 0.6);
}

TEST(WavesAcrossTheFlanks, LeaveAScaleItsName) {
  const MadeGear gear = spur(23);
  const auto waved = [](auto&, const FlankSpot& s, auto&) {
    return 12.0 * std::cos(4.4 * s.u + 8.5 * s.v);
  };
  const auto result =
      close(gear, scan_of(gear, {scaled(-0.2), grown(waved)}, scanned(9000, 1.5, 1)), true);
  expect_size(result, "scale", "percent", -0.2, 0.01);
}

TEST(NamesWithAPlace, StandBesideARiseInsteadOfTwoThatUndoEachOther) {
  const MadeGear gear = spur(22);
  const auto filled = [](auto&, const FlankSpot& s, auto&) {
    return relief_um(s) + 24.0 * std::exp(-(s.u + 1.0) / 0.26);
  };
  // (other errors may leave a bow beside a curve, which has a value less)
  const auto result = close(gear, inspection_of(gear, {grown(filled)}, traced({1, 8, 15}, 1.6, 2)));
  expect_size(result, "tip_relief", "amount_um", 12.0, 1.5);
  EXPECT_TRUE(tells(result, "towards the root, within")) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(FormsOfSomeTeeth, AGrooveIsOneFormBesideACrowning) {
  const MadeGear gear = spur(32);
  // From tooth 29 on, and over tooth 1: the first tooth says nothing of the others.
  const auto worn = [&](auto&, const FlankSpot& s, auto&) {
    const bool is_in = s.tooth >= 29 || s.tooth <= 4;
    return (is_in ? -6.0 * std::exp(-std::pow((s.u + 0.2) / 0.25, 2)) : 0.0) - 5.0 * s.u * s.u;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    InspectionOptions options = traced({}, 0.8, seed);
    options.points = 60;
    const auto result = close(gear, inspection_of(gear, {grown(worn)}, options));
    expect_size(result, "profile_crowning", "amount_um", 5.0, 0.2);
    EXPECT_TRUE(tells(result, "on 8 teeth from tooth 29 on, a groove over the profile"))
        << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(FormsOfSomeTeeth, ARidgeIsNoSectorAndNoSpots) {
  const MadeGear gear = spur(30);
  const auto ridged = [&](auto&, const FlankSpot& s, auto&) {
    const bool is_in = s.tooth >= 12 && s.tooth <= 14;
    return (is_in ? 10.0 * std::exp(-std::pow((s.v - 0.3) / 0.16, 2)) : 0.0) - 6.0 * s.v * s.v;
  };
  const auto lines = close(gear, inspection_of(gear, {grown(ridged)}, traced({}, 1.0, 1)));
  const auto cloud = close(gear, scan_of(gear, {grown(ridged)}, scanned(9000, 1.5, 2)), true);
  for (const loop::LoopResult* result : {&lines, &cloud}) {
    expect_size(*result, "crowning", "amount_um", 6.0, 0.3);
    EXPECT_TRUE(tells(*result, "on 3 teeth from tooth 12 on, a ridge over the face"))
        << list(*result);
    EXPECT_FALSE(tells_spot(*result)) << list(*result);
    EXPECT_EQ(result->effects.size(), 2U) << list(*result);
  }
}

}  // namespace
}  // namespace trueflank::test
