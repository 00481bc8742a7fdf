// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"

// One flank that is off by itself in a scan: how the part is turned about its axis is fitted, so
// half of its height on both flanks looks the same.
namespace trueflank::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The right flanks are worn but for a ridge at mid profile.
Process worn_beside_a_ridge(double um) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? um * (std::exp(-std::pow((s.u + 0.1) / 0.25, 2)) - 1.0) : 0.0;
  });
}
Process thinned(double um) {
  return grown([=](auto&, const FlankSpot&, auto&) { return -um; });
}

/// The scan in a frame that is turned about the gear's axis, by as much as moves its flanks by
/// `um`.
loop::ScanData turned_by(double um, loop::ScanData scan) {
  const double angle = 1e-3 * um / geometry_of(spur(24)).base_radius_mm();
  for (auto& p : scan.points_mm)
    p = {p[0] * std::cos(angle) - p[1] * std::sin(angle),
         p[0] * std::sin(angle) + p[1] * std::cos(angle), p[2]};
  return scan;
}

TEST(OneFlank, WornBesideARidgeIsNoThinTooth) {
  const auto scan = scan_of(spur(24), {worn_beside_a_ridge(20)}, scanned(2000, 1.5, 3));
  // (as given, the frame bears it out: nothing is open)
  for (const auto& effect : close(spur(24), scan, true).effects)
    EXPECT_THAT(effect.sentence, Not(HasSubstr("or both flanks"))) << effect.sentence;
  const auto result = close(spur(24), turned_by(30.0, scan), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  for (const auto& effect : result.effects) EXPECT_EQ(effect.flank, "right") << list(result);
  ASSERT_EQ(result.effects.size(), 2U) << list(result);
  const auto& level = result.effects.back();
  EXPECT_NEAR(std::abs(parameter(level, "amplitude_um").value), 20.0, 1.0) << list(result);
  EXPECT_THAT(level.sentence, HasSubstr("or both flanks do by "));
}

TEST(OneFlank, ThinTeethBesideASmallRidgeOfOneFlankStayThinTeethAndTheTurnIsSaidToBeOpen) {
  const auto ridge = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? 6.0 * std::exp(-std::pow((s.u - 0.1) / 0.15, 2)) : 0.0;
  });
  const auto scan = scan_of(spur(24), {thinned(20), ridge}, scanned(2000, 1.5, 4));
  const auto as_given = close(spur(24), scan, true);
  ASSERT_NE(find(as_given, "contour_offset"), nullptr) << list(as_given);
  EXPECT_THAT(find(as_given, "contour_offset")->sentence, Not(HasSubstr("one side alone")));
  const auto result = close(spur(24), turned_by(30.0, scan), true);
  const auto* thin = find(result, "contour_offset");
  ASSERT_NE(thin, nullptr) << list(result);
  EXPECT_THAT(thin->sentence, HasSubstr("or flanks of one side alone do by 4"));
  EXPECT_THAT(thin->sentence,
              HasSubstr("a scan does not show how the part is turned about its axis"));
  EXPECT_THAT(thin->sure, HasSubstr("on which flanks is open"));
}

// Flanks of one side move no tip.
TEST(OneFlank, WallsThatAreAllOutWithTheTipsAreNotPerhapsOnesOfOneSide) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937_64 random(seed);
    const double um = std::uniform_real_distribution<double>(15.0, 40.0)(random);
    const auto out = grown([=](auto&, const FlankSpot&, auto&) { return um; });
    ScanOptions options = scanned(3000, 3.0, seed);
    options.any_pose = false;
    loop::ScanData scan = scan_of(spur(24), {out}, options);
    add_tips(spur(24), 100.0 * 1e-3 * um / spur(24).tip_mm, scan);
    const auto result = close(spur(24), scan, false);
    const auto* offset = find(result, "contour_offset");
    ASSERT_NE(offset, nullptr) << list(result);
    EXPECT_THAT(offset->sentence, Not(HasSubstr("one side alone"))) << offset->sentence;
  }
}

// Not as a level of both and a groove of one over its whole profile.
TEST(OneFlank, ALevelOfOneSideInTracesOfACommonZeroIsOneForm) {
  int one_form = 0;
  const int kDraws = survey_size(3, 6);
  for (unsigned seed = 1; seed <= static_cast<unsigned>(kDraws); ++seed) {
    std::mt19937_64 random(40 + seed);
    const double um =
        std::uniform_real_distribution<double>(4.0, 9.0)(random) * (seed % 3 == 0 ? -1.0 : 1.0);
    const int side = seed % 2 == 0 ? 1 : -1;
    InspectionOptions options = traced({1, 5, 10, 15, 19, 24}, 0.9, seed);
    options.common_zero = true;
    const auto out =
        grown([=](auto&, const FlankSpot& s, auto&) { return s.side == side ? um : 0.0; });
    const auto result = close(spur(26), inspection_of(spur(26), {out}, options));
    const char* flank = side > 0 ? "left" : "right";
    one_form +=
        result.effects.size() == 1 && result.effects[0].flank == flank &&
                std::abs(parameter(result.effects[0], "amplitude_um").value - std::abs(um)) < 0.3
            ? 1
            : 0;
    if (result.effects.size() != 1) std::printf("%s\n", list(result).c_str());
  }
  EXPECT_EQ(one_form, kDraws);
}

TEST(OneFlank, EveryThirdFlankOfOneSideIsNoWaveAndNoThinTooth) {
  const auto third = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 && s.tooth % 3 == 2 ? -10.0 : 0.0;
  });
  const auto result = close(
      spur(48),
      scan_of(spur(48), {third, off_centre(17, 20), leaning(3.2, -16)}, scanned(4000, 3.3, 5)),
      true);
  EXPECT_EQ(find(result, "tooth_thickness"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "one tooth in 3, from tooth 2 on, lies back")) << list(result);
}

TEST(OneFlank, WavesOfOneSideAreOneFormAndNotHalfOfItEqualAndHalfOpposite) {
  const auto waves = grown([](auto& g, const FlankSpot& s, auto&) {
    return s.side < 0 ? 9.0 * s.v * std::cos(2.0 * M_PI * 3.0 * s.tooth / g.teeth) : 0.0;
  });
  const auto result = close(spur(30), scan_of(spur(30), {waves}, scanned(2000, 2.0, 6)), true);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_EQ(result.effects[0].flank, "right") << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 9.0, 0.5) << list(result);
}

/// An index and nothing else.
InspectionOptions index_of_teeth(double noise_um, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

TEST(OneFlank, AWaveOfItsOwnIsNoPitchWaveAndLobingThatCancelOnTheOther) {
  std::mt19937 random(624);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (unsigned draw = 1; draw <= survey_size(3U, 12U); ++draw) {
    const MadeGear gear = spur(40 + static_cast<int>(20.0 * uniform(random)));
    const double left_um = 2.0 + 2.0 * uniform(random), right_um = 0.8 * left_um,
                 left_rad = 6.28 * uniform(random), right_rad = 6.28 * uniform(random);
    const int left = 3 + static_cast<int>(3.0 * uniform(random)), right = left + 2;
    const auto waves = grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
      const double angle = 2.0 * M_PI * (s.tooth - 1) / g.teeth;
      return s.side > 0 ? left_um * std::cos(left * angle - left_rad)
                        : right_um * std::cos(right * angle - right_rad);
    });
    const auto result = close(gear, inspection_of(gear, {waves}, index_of_teeth(0.25, draw)));
    SCOPED_TRACE(list(result));
    EXPECT_FALSE(has_name(result));
    ASSERT_EQ(result.effects.size(), 2U);
    for (const auto& effect : result.effects) {
      const bool of_left = effect.flank == "left";
      EXPECT_EQ(effect.flank, of_left ? "left" : "right");
      EXPECT_NEAR(parameter(effect, "amplitude_um").value, of_left ? left_um : right_um, 0.3);
    }
    EXPECT_TRUE(tells(result, std::to_string(left) + " times per turn"));
    EXPECT_TRUE(tells(result, std::to_string(right) + " times per turn"));
  }
}

// Of waves that do not cancel both names stay.
TEST(OneFlank, APitchWaveAndLobesOfOneOrderKeepTheirNames) {
  for (unsigned draw = 1; draw <= survey_size(2U, 6U); ++draw) {
    const MadeGear gear = spur(48);
    const double deg = 57.0 * draw, pitch_um = 3.2, round_um = 9.0;
    const auto result = close(
        gear,
        inspection_of(gear, {indexed(5, pitch_um, deg), out_of_round(5, round_um, deg + 63.0)},
                      index_of_teeth(0.25, draw)));
    SCOPED_TRACE(list(result));
    EXPECT_EQ(result.effects.size(), 2U);
    expect_size(result, "pitch_wave", "amplitude_um", pitch_um, 0.1 * pitch_um);
    expect_size(result, "lobing", "amplitude_um", round_um, 0.1 * round_um);
  }
}

}  // namespace
}  // namespace trueflank::test
