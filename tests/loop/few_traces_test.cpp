// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"

// The usual sheet: profile and helix on three or four teeth, index on all.
namespace trueflank::test {
namespace {

InspectionOptions sheet(const MadeGear& gear, int teeth, unsigned seed) {
  InspectionOptions options;
  for (int k = 0; k < teeth; ++k) options.teeth.push_back(1 + k * gear.teeth / teeth);
  options.points = 50;
  options.noise_um = 0.4;
  options.correlation = 0.4;
  options.seed = seed;
  return options;
}

TEST(FewTraces, FourTeethTellWhatAllTheirFlanksShare) {
  const MadeGear gear = spur(24);
  const auto slope = [](auto&, const FlankSpot& s, auto&) { return 4.0 * s.v * s.side; };
  const auto result = close(gear, inspection_of(gear, {grown(slope)}, sheet(gear, 4, 3)));
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  ASSERT_EQ(result.effects[0].id, "helix_error") << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "slope_um").value, 8.0, 0.4);
  EXPECT_LT(result.after.held_out_rms, 0.3 * result.before.held_out_rms);
}

TEST(FewTraces, OneFlankOfFourTeethIsEnough) {
  const MadeGear gear = spur(24);
  const auto slope = [](auto&, const FlankSpot& s, auto&) { return s.side > 0 ? 3.0 * s.u : 0.0; };
  const auto result = close(gear, inspection_of(gear, {grown(slope)}, sheet(gear, 4, 4)));
  const auto* found = find(result, "pressure_angle_error");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_EQ(found->flank, "left");
  EXPECT_NEAR(parameter(*found, "slope_um").value, 6.0, 0.5);
}

TEST(FewTraces, AHollowOnOneFlankIsFound) {
  const MadeGear gear = spur(24);
  const auto hollow = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 ? -8.0 * std::exp(-std::pow((s.u + 0.3) / 0.36, 2)) : 0.0;
  };
  const auto result = close(gear, inspection_of(gear, {grown(hollow)}, sheet(gear, 4, 8)));
  const auto* found = find(result, "flank_wear");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_EQ(found->flank, "left");
  EXPECT_NEAR(parameter(*found, "depth_um").value, 8.0, 0.8);
}

TEST(FewTraces, WavesThatFourTeethCannotShowAreNoCandidates) {
  // Of order 4 four teeth show the cosine alone; a fitted sine of rounding would be of any size.
  const MadeGear gear = spur(24);
  const auto slope = [](auto&, const FlankSpot& s, auto&) { return 4.0 * s.v * s.side; };
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto result = close(gear, inspection_of(gear, {grown(slope)}, sheet(gear, 4, 40 + seed)));
    ASSERT_NE(find(result, "helix_error"), nullptr) << list(result);
    for (const auto& effect : result.effects)
      for (const auto& p : effect.parameters) EXPECT_LT(std::abs(p.value), 1e3) << list(result);
  }
}

TEST(FewTraces, ThreeTeethToo) {
  const MadeGear gear = ring(54);
  const auto crowned = [](auto&, const FlankSpot& s, auto&) { return -6.0 * s.v * s.v; };
  const auto result = close(gear, inspection_of(gear, {grown(crowned)}, sheet(gear, 3, 5)));
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "crowning");
}

TEST(FewTraces, TracesAtOneDiameterAndOneHeightShowNoTwist) {
  const MadeGear gear = spur(24);
  const auto tapered = [](auto&, const FlankSpot& s, auto&) { return -4.0 * s.v; };
  const auto result = close(gear, inspection_of(gear, {grown(tapered)}, sheet(gear, 4, 6)));
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "taper");
  EXPECT_NE(std::find(result.not_observable.begin(), result.not_observable.end(), "flank_twist"),
            result.not_observable.end());
}

TEST(FewTraces, AlarmsAreRareWhereNothingIsHidden) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const int teeth : {3, 4}) {
      const MadeGear gear = spur(24);
      const auto result = close(gear, inspection_of(gear, {}, sheet(gear, teeth, 100 + seed)));
      alarms += result.verdict != loop::Verdict::kNoEffect || !result.effects.empty();
    }
  // At 5 % six or more come once in seventy such tests.
  EXPECT_LE(alarms, 5);
}

}  // namespace
}  // namespace trueflank::test
