// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/loop/one_drawn_form.h"

// Forms that were told in pieces, or as the mean that they have, with a name: across traces, on
// both flanks, on one tooth, around the gear, in one view of a scan.
namespace trueflank::test {
namespace {

constexpr double kPi = std::numbers::pi;

Draw draw_of(unsigned seed) { return Draw(seed * 7919U + 11U); }

TEST(FormsAcrossTraces, AHollowThatGrowsTowardsAnEndIsNoWearOfItsMean) {
  for (unsigned seed = 1; seed <= survey_size(3U, 8U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(19, 37));
    const double um = draw.between(6.0, 14.0), at = draw.between(-0.3, 0.3),
                 half = draw.between(0.25, 0.4);
    const bool upper = draw.whole(0, 1) == 1;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return -um * bell_of(s.u - at, half) * 0.5 * (1.0 + (upper ? s.v : -s.v));
    });
    InspectionOptions options = traced({2, 5, 8, 11, 14, 17}, draw.between(0.6, 1.1), seed);
    options.helix = false;
    options.profiles_at = {-0.7, 0.0, 0.7};
    const auto result = close(gear, inspection_of(gear, {made}, options));
    expect_one_of_size(result, um, 0.12);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_TRUE(tells(result, upper ? "on towards the upper end: there the flanks lie back"
                                    : "on towards the lower end: there the flanks lie back"))
        << list(result);
  }
}

TEST(FormsAcrossTraces, AHollowThatIsAlikeAtEveryHeightKeepsItsName) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(19, 37));
    const double um = draw.between(5.0, 12.0), half = draw.between(0.25, 0.4);
    const auto made =
        grown([&](auto&, const FlankSpot& s, auto&) { return -um * bell_of(s.u, half); });
    InspectionOptions options = traced({2, 5, 8, 11, 14, 17}, 0.8, seed);
    options.helix = false;
    options.profiles_at = {-0.7, 0.0, 0.7};
    const auto result = close(gear, inspection_of(gear, {made}, options));
    EXPECT_NE(find(result, "flank_wear"), nullptr) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
  }
}

TEST(FormsAcrossTraces, AHollowThatBeginsAtAHeightIsNoneThatGrows) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(19, 37));
    const double um = draw.between(7.0, 14.0), at = draw.between(-0.3, 0.3),
                 half = draw.between(0.25, 0.4), from = draw.between(-0.4, 0.4);
    const bool upper = draw.whole(0, 1) == 1;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return (upper ? s.v > from : s.v < from) ? -um * bell_of(s.u - at, half) : 0.0;
    });
    InspectionOptions options = traced({2, 5, 8, 11, 14, 17}, draw.between(0.6, 1.1), seed);
    options.helix = false;
    options.profiles_at = {-0.85, -0.5, -0.15, 0.15, 0.5, 0.85};
    const auto result = close(gear, inspection_of(gear, {made}, options));
    expect_one_of_size(result, um, 0.1);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_FALSE(tells(result, "evenly")) << list(result);
  }
}

TEST(WavesOfBothFlanks, OppositeOnesAreOneWave) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(17, 33));
    const double um = draw.between(9.0, 15.0), waves = draw.between(2.1, 3.4),
                 phase = draw.between(0.0, 6.28);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.side * um * std::cos(kPi * waves * s.v + phase);
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 4.0, seed)), true);
    expect_one_of_size(result, um, 0.08);
    EXPECT_TRUE(tells(result, "opposite on the two flanks")) << list(result);
  }
}

TEST(ProductOfCourses, GrowsTowardsTheMiddle) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = seed % 2 == 0 ? ring(44) : spur(draw.whole(23, 40));
    const double um = draw.between(16.0, 30.0);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return um * 0.5 * (1.0 + s.u) * (1.0 - s.v * s.v);
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6400, 5.0, seed)), true);
    expect_one_of_size(result, um, 0.1);
    EXPECT_TRUE(tells(result,
                      "an excess of material grows towards the tip evenly, and that the "
                      "more, towards the middle of the face"))
        << list(result);
  }
}

// Powder pressed from both ends: the radius grows from a neutral zone.
TEST(WaistOfTheBody, IsOneRadius) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(20, 30));
    const double um = draw.between(50.0, 80.0), at = draw.between(-0.4, 0.4),
                 sign = draw.whole(0, 1) == 1 ? 1.0 : -1.0;
    const Process pressed{
        .move_um = [&](const MadeGear&, const FlankSpot& s, const Vec3& p) -> Vec3 {
          const double out = sign * um * std::abs(s.v - at) / (1.0 + std::abs(at)),
                       radius = std::hypot(p[0], p[1]);
          return {out * p[0] / radius, out * p[1] / radius, 0.0};
        }};
    const auto result = close(gear, scan_of(gear, {pressed}, scanned(6000, 5.0, seed)), true);
    expect_one_of_size(result, um, 0.08);
    EXPECT_TRUE(tells(result, "on to both sides, by ")) << list(result);
  }
}

// Points moved along the axis, twice per turn: no lobes beside a stretch that take each other back.
TEST(SaddleOfAHelicalGear, IsOneMoveAlongTheAxisAndHasNoName) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = helical(draw.whole(28, 40), draw.between(18.0, 28.0));
    const double um = draw.between(40.0, 70.0), phase = draw.between(0.0, 6.28);
    const Process bent{.move_um = [&](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
      return {0.0, 0.0, um * std::cos(2.0 * std::atan2(p[1], p[0]) - phase)};
    }};
    const auto result = close(gear, scan_of(gear, {bent}, scanned(5000, 4.0, seed)), true);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "moved along the axis by their direction, twice per turn"))
        << list(result);
    EXPECT_NEAR(amplitude_of_first(result), um, 0.06 * um) << list(result);
  }
}

TEST(ScratchOfOneTooth, IsOneLineAslant) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(13, 19));
    const int tooth = draw.whole(2, 12), side = draw.whole(0, 1) == 1 ? 1 : -1;
    const double um = draw.between(45.0, 70.0), slope = draw.between(0.5, 0.9),
                 sign = draw.whole(0, 1) == 1 ? 1.0 : -1.0;
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return s.tooth == tooth && s.side == side ? sign * um * bell_of(s.u - slope * s.v, 0.18)
                                                : 0.0;
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(7000, 4.0, seed)), true);
    expect_one_of_size(result, um, 0.15);
    EXPECT_TRUE(tells(result, "on tooth " + std::to_string(tooth) + " alone, a " +
                                  (sign > 0.0 ? "ridge" : "groove") + " in a line aslant"))
        << list(result);
  }
}

TEST(BrokenCornerOfOneTooth, IsACornerAndNoHollowOfTheBody) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(17, 24));
    const int tooth = draw.whole(3, 15);
    const double um = draw.between(70.0, 110.0), reach = draw.between(0.55, 0.75);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      const double over = 0.5 * (1.0 + s.u) + 0.5 * (1.0 + s.v) - (2.0 - reach);
      return s.tooth == tooth && over > 0.0 ? -um * over / reach : 0.0;
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(9000, 5.0, seed)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    EXPECT_TRUE(tells(result, "on tooth " + std::to_string(tooth) +
                                  " alone, the corner at the tip and the upper end lies back"))
        << list(result);
    EXPECT_FALSE(tells(result, "of the body")) << list(result);
  }
}

TEST(BlocksAroundTheGear, AreSectorsThatComeAgain) {
  for (unsigned seed = 1; seed <= survey_size(3U, 8U); ++seed) {
    Draw draw = draw_of(seed);
    const int number = draw.whole(2, 4), teeth = number * draw.whole(9, 14), apart = teeth / number,
              count = draw.whole(3, apart - 3), first = draw.whole(1, apart);
    const MadeGear gear = spur(teeth);
    const double um = draw.between(6.0, 12.0);
    const auto made = grown([&](auto&, const FlankSpot& s, auto&) {
      return (s.tooth - first + teeth) % apart < count ? s.side * um : 0.0;
    });
    InspectionOptions options = traced({}, draw.between(0.4, 0.7), seed);
    options.profile = options.helix = false;
    options.index = true;
    const auto result = close(gear, inspection_of(gear, {made}, options));
    expect_one_of_size(result, um, 0.1);
    EXPECT_TRUE(tells(result, "each of " + std::to_string(number) + " sectors of "))
        << list(result);
  }
}

TEST(ViewsOfAScan, ThatDoNotMeetAreOnePartWhateverTeethTheEdgeRunsThrough) {
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(21, 32));
    const double um = draw.between(30.0, 50.0), towards = draw.between(0.0, 6.28),
                 pitch = 2.0 * kPi / gear.teeth,
                 from = pitch * (draw.whole(1, gear.teeth) + draw.between(-0.1, 0.1)),
                 over = pitch * (gear.teeth / 3 + draw.between(-0.1, 0.1));
    const Process shifted{.move_um = [&](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
      const double off = std::atan2(p[1], p[0]) - from;
      const double on = off - 2.0 * kPi * std::floor(off / (2.0 * kPi)) < over ? um : 0.0;
      return {on * std::cos(towards), on * std::sin(towards), 0.0};
    }};
    const auto result = close(gear, scan_of(gear, {shifted}, scanned(6000, 4.0, seed)), true);
    expect_one_of_size(result, um, 0.05);
    EXPECT_TRUE(tells(result, "all points from ")) << list(result);
  }
}

// A disturbance of the probe: every trace has it, each in a phase of its own.
TEST(HumOfTraces, IsToldOfAllFlanksAndIsNoNoise) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(23, 41));
    const double um = draw.between(4.0, 7.0), noise = draw.between(0.8, 1.2),
                 periods = draw.between(8.0, 14.0);
    loop::InspectionData data = inspection_of(gear, {}, traced({1, 5, 9, 13, 17, 21}, noise, seed));
    double phase = 0.0, along = 0.0;
    const loop::InspectionRow* before = nullptr;
    const int points = 120;
    for (loop::InspectionRow& row : data.rows) {
      if (before == nullptr || row.record != before->record || row.tooth != before->tooth ||
          row.flank != before->flank) {
        phase = draw.between(0.0, 6.28);
        along = 0.0;
      }
      row.deviation_um += um * std::cos(2.0 * kPi * periods * along++ / points + phase);
      before = &row;
    }
    const auto result = close(gear, data);
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_EQ(result.effects.size(), 0U) << list(result);
    for (const char* flanks : {"every tooth, left flanks", "every tooth, right flanks"})
      EXPECT_TRUE(tells(result, flanks)) << list(result);
    EXPECT_TRUE(tells(result, "waves over the profile") && tells(result, "waves over the face"))
        << list(result);
    EXPECT_GT(result.noise, 0.8 * noise) << list(result);
    EXPECT_LT(result.noise, 1.2 * noise) << list(result);
  }
}

// One wild value of an index beside leads of other teeth: no lean of a profile, and no gap.
TEST(WildValueOfAnIndex, IsNoLeanOfAToothThatWasNotTraced) {
  for (unsigned seed = 1; seed <= survey_size(4U, 16U); ++seed) {
    Draw draw = draw_of(seed);
    const MadeGear gear = spur(draw.whole(22, 34));
    InspectionOptions options = traced({1, 6, 17}, 1.1, seed);
    options.profile = false;
    options.index = true;
    loop::InspectionData data = inspection_of(gear, {}, options);
    for (int number = 1; number <= gear.teeth; ++number) {
      loop::InspectionRow runout = data.rows.back();
      runout.record = loop::RecordKind::kRadial;
      runout.tooth = number;
      runout.deviation_um = draw.between(-1.5, 1.5);
      data.rows.push_back(runout);
    }
    const int tooth = draw.whole(8, 15);
    const Flank flank = draw.whole(0, 1) == 1 ? Flank::kLeft : Flank::kRight;
    for (loop::InspectionRow& row : data.rows)
      if (row.record == loop::RecordKind::kIndex && row.tooth == tooth && row.flank == flank)
        row.deviation_um += draw.between(10.0, 16.0);
    const auto result = close(gear, data);
    EXPECT_FALSE(tells(result, "leans over the profile")) << list(result);
    EXPECT_FALSE(tells(result, "the gap between")) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
