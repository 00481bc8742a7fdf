// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/discovery/course_scan.h"

// What one tooth, or some teeth side by side, have by themselves.
namespace trueflank::test {
namespace {

bool is_on(const FlankSpot& s, int tooth, int side = 0) {
  return s.tooth == tooth && (side == 0 || s.side == side);
}

TEST(ToothAskew, IsOneLeanOfItsTwoFlanksInScansAndTraces) {
  const MadeGear gear = spur(20);
  const auto askew = [](auto&, const FlankSpot& s, auto&) {
    return is_on(s, 7) ? 6.0 * s.side * s.v : 0.0;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto scanned_one =
        close(gear, scan_of(gear, {grown(askew)}, scanned(8000, 1.0, seed)), true);
    EXPECT_EQ(scanned_one.effects.size(), 1U) << list(scanned_one);
    EXPECT_TRUE(tells(scanned_one,
                      "tooth 7 alone leans over the face: the upper end stands counter-clockwise"))
        << list(scanned_one);
  }
  InspectionOptions options;
  options.points = 80;
  options.noise_um = 1.0;
  options.seed = 3;
  const auto traced_one = close(gear, inspection_of(gear, {grown(askew)}, options));
  EXPECT_TRUE(tells(traced_one,
                    "tooth 7 alone leans over the face: the upper end stands counter-clockwise"))
      << list(traced_one);
}

TEST(ToothAskew, OfManyIsNoSectorsThatUndoEachOther) {
  const MadeGear gear = spur(66);
  const auto askew = [](auto&, const FlankSpot& s, auto&) {
    return (is_on(s, 41) ? -17.0 * s.side * s.v : 0.0) - 11.0 * s.v * s.v;
  };
  InspectionOptions options;
  options.points = 60;
  options.noise_um = 1.3;
  for (options.seed = 9; options.seed <= survey_size(9U, 10U); ++options.seed) {
    const auto result = close(gear, inspection_of(gear, {grown(askew)}, options));
    EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "tooth 41 alone leans over the face")) << list(result);
    EXPECT_FALSE(tells(result, "sector")) << list(result);
  }
}

// Once one run was told, the first tooth of the next was passed over: the others were three single
// teeth, or a sector and a tooth beside it that stands out by nothing.
TEST(RunsOfTeeth, OfEitherFlankAreOneFormEach) {
  const MadeGear gear = spur(40);
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.6;
  for (const double right_um : {-12.0, 30.0})
    for (options.seed = 1; options.seed <= 2; ++options.seed) {
      const auto stand_out = [=](auto&, const FlankSpot& s, auto&) {
        if (s.side > 0) return s.tooth >= 3 && s.tooth <= 6 ? 20.0 : 0.0;
        return s.tooth >= 20 && s.tooth <= 22 ? right_um : 0.0;
      };
      const auto result = close(gear, inspection_of(gear, {grown(stand_out)}, options));
      EXPECT_EQ(result.effects.size(), 2U) << list(result);
      EXPECT_TRUE(tells(result, "a sector of 4 teeth from tooth 3 on")) << list(result);
      EXPECT_TRUE(tells(result, "a sector of 3 teeth from tooth 20 on")) << list(result);
    }
}

TEST(FlankThatLeansOverItsProfile, IsNoHeightAndNoSpots) {
  const MadeGear gear = spur(24);
  for (const int side : {1, -1}) {
    const auto leans = [=](auto&, const FlankSpot& s, auto&) {
      return is_on(s, 5, side) ? 9.0 * s.u : 0.0;
    };
    const auto result = close(gear, scan_of(gear, {grown(leans)}, scanned(6000, 1.0, 4)), true);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "tooth 5 alone leans over the profile")) << list(result);
  }
}

TEST(ToothCrownedByItself, IsOneBow) {
  const MadeGear gear = spur(22);
  const auto crowned = [](auto&, const FlankSpot& s, auto&) {
    return is_on(s, 11) ? -8.0 * s.v * s.v : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(crowned)}, scanned(9000, 1.0, 5)), true);
  EXPECT_TRUE(tells(result, "tooth 11 alone is bowed over the face")) << list(result);
  EXPECT_FALSE(tells_spot(result)) << list(result);
}

TEST(StylusThatSlips, IsAStepOfOneTrace) {
  const MadeGear gear = spur(26);
  const auto slipped = [](auto&, const FlankSpot& s, auto&) {
    return is_on(s, 9, -1) && s.v > -0.3 ? 8.0 : 0.0;
  };
  InspectionOptions options;
  options.points = 90;
  options.noise_um = 0.8;
  options.seed = 6;
  const auto result = close(gear, inspection_of(gear, {grown(slipped)}, options));
  EXPECT_TRUE(tells(result, "on tooth 9 alone, a step over the face")) << list(result);
  EXPECT_FALSE(tells_spot(result)) << list(result);
}

TEST(GrooveOfASector, IsNoGrooveOfAllTeeth) {
  const MadeGear gear = spur(40);
  const auto worn = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth >= 12 && s.tooth < 26
               ? -9.0 * std::exp(-std::pow((s.u - 0.1) / 0.25, 2))
               : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(worn)}, scanned(9000, 1.0, 7)), true);
  EXPECT_TRUE(tells(result, "on 14 teeth from tooth 12 on, a groove")) << list(result);
  EXPECT_FALSE(tells(result, "the same on every tooth, a groove")) << list(result);
}

TEST(WavesOfSomeTeeth, AreOneFormOnThese) {
  for (const int teeth : {14, 44}) {
    const MadeGear gear = spur(teeth);
    const int count = teeth / 4;
    const auto supported = [&](auto&, const FlankSpot& s, auto&) {
      return s.tooth >= 6 && s.tooth < 6 + count ? 7.0 * std::cos(6.5 * 3.14159 * s.v) : 0.0;
    };
    const auto result =
        close(gear, scan_of(gear, {grown(supported)}, scanned(8000, 1.2, 21)), true);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(
        result, "on " + std::to_string(count) + " teeth from tooth 6 on, 6.5 waves over the face"))
        << list(result);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  }
}

/// 1 on teeth within some teeth of a middle, with edges over about four times `edge` teeth.
double soft_run(int teeth, int tooth, double middle, double half, double edge) {
  const double off = std::abs(std::remainder(tooth - middle, teeth));
  return 1.0 / (1.0 + std::exp((off - half) / edge));
}

TEST(RidgeOnOneSide, IsOneFormWithSoftEdges) {
  const MadeGear gear = spur(48);
  const auto ridge = [](auto&, const FlankSpot& s, auto&) {
    return 9.0 * std::exp(-std::pow((s.v - 0.2) / 0.12, 2)) * soft_run(48, s.tooth, 30.0, 9.0, 1.1);
  };
  const auto result = close(gear, scan_of(gear, {grown(ridge)}, scanned(9000, 1.8, 22)), true);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_TRUE(tells(result, "with soft edges over about")) << list(result);
  EXPECT_TRUE(tells(result, "a ridge over the face")) << list(result);
}

TEST(GrooveOfSomeTracesBesideASlope, IsOneFormOnTheseTeeth) {
  const MadeGear gear = spur(36);
  const auto worn = [](auto&, const FlankSpot& s, auto&) {
    return 1.5 * s.u + (s.side > 0 && s.tooth >= 20 && s.tooth < 29
                            ? -5.0 * std::exp(-std::pow((s.u + 0.1) / 0.25, 2))
                            : 0.0);
  };
  InspectionOptions options;
  options.points = 80;
  options.noise_um = 0.9;
  options.index = false;
  options.seed = 23;
  const auto result = close(gear, inspection_of(gear, {grown(worn)}, options));
  EXPECT_TRUE(tells(result, "on 9 teeth from tooth 20 on, a groove over the profile"))
      << list(result);
  EXPECT_FALSE(tells(result, "sector")) << list(result);
  EXPECT_NE(find(result, "pressure_angle_error"), nullptr) << list(result);
}

TEST(SectorWithSoftEdges, IsOneForm) {
  const MadeGear gear = spur(40);
  for (const bool aside : {false, true}) {
    const auto proud = [&](auto&, const FlankSpot& s, auto&) {
      return 10.0 * (aside ? s.side : 1.0) * soft_run(40, s.tooth, 27.3, 6.6, 0.6) + 4.0 * s.v;
    };
    const auto result = close(gear, scan_of(gear, {grown(proud)}, scanned(9000, 1.6, 24)), true);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
    EXPECT_NE(find(result, "taper"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "a sector of about 13 teeth around tooth 27.3")) << list(result);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  }
}

TEST(SectorWithSoftEdges, OfOneFlankIsOneFormAndNoEccentricity) {
  const MadeGear gear = spur(48);
  const auto worn = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 ? -15.0 * soft_run(48, s.tooth, 19.5, 7.7, 0.67) : 0.0;
  };
  for (const double off_um : {0.0, 8.0}) {
    std::vector<Process> processes{grown(worn)};
    if (off_um > 0.0) processes.push_back(off_centre(off_um, 70.0));
    const auto result = close(gear, scan_of(gear, processes, scanned(6000, 2.5, 25)), true);
    EXPECT_EQ(result.effects.size(), off_um > 0.0 ? 2U : 1U) << list(result);
    EXPECT_TRUE(tells(result, "a sector of about 15 teeth around tooth 19.")) << list(result);
    EXPECT_EQ(result.effects[0].flank, "left") << list(result);
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 15.0, 0.6) << list(result);
    if (off_um > 0.0) {
      expect_size(result, "eccentricity", "amplitude_um", off_um, 0.3);
      expect_size(result, "eccentricity", "phase_deg", 70.0, 3.0);
    }
  }
}

TEST(LeanOfMostTeeth, OfOneFlankIsNoLeanOfTheOthers) {
  // Of 28 teeth 16; more than a sector was sought on.
  const MadeGear gear = spur(28);
  const auto leaning = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth >= 13 ? -18.0 * s.u : 0.0;
  };
  const auto result = close(gear, scan_of(gear, {grown(leaning)}, scanned(8000, 2.8, 26)), true);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_TRUE(tells(result, "16 teeth from tooth 13 on")) << list(result);
  EXPECT_EQ(result.effects[0].flank, "left") << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 18.0, 0.8) << list(result);
}

TEST(WavesOfFewTraces, NameTheirTeeth) {
  const MadeGear gear = spur(30);
  const auto shaken = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth >= 14 && s.tooth <= 16
               ? 4.0 * std::cos(17.0 * 3.14159 * s.v + s.tooth)
               : 0.0;
  };
  InspectionOptions options;
  options.points = 100;
  options.noise_um = 0.8;
  options.seed = 8;
  const auto result = close(gear, inspection_of(gear, {grown(shaken)}, options));
  EXPECT_NE(result.structure_left.find("on teeth 14 to 16"), std::string::npos)
      << result.structure_left;
}

}  // namespace
}  // namespace trueflank::test
