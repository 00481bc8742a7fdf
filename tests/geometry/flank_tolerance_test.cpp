// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/flank_tolerance.h"

#include <gtest/gtest.h>

namespace trueflank {
namespace {

ToleranceSize size() {
  return {.teeth = 40, .reference_diameter_mm = 120.0, .normal_module_mm = 3.0,
          .face_width_mm = 30.0};
}

// By hand: class 6 is sqrt(2) times the brackets of the standard.
TEST(FlankTolerance, MatchesTheHandCalculation) {
  const FlankTolerances t = flank_tolerances(size(), 6).value();
  EXPECT_EQ(t.single_pitch_um, 9.0);             // 1.41421 x 6.32 = 8.94
  EXPECT_EQ(t.total_cumulative_pitch_um, 29.0);  // 1.41421 x 20.3649 = 28.80
  EXPECT_EQ(t.profile_slope_um, 7.5);            // 1.41421 x 5.32 = 7.52
  EXPECT_EQ(t.profile_form_um, 9.5);             // 1.41421 x 6.65 = 9.40
  EXPECT_EQ(t.total_profile_um, 12.0);           // hypot(7.5236, 9.4045) = 12.04
  EXPECT_EQ(t.helix_slope_um, 9.0);              // 1.41421 x 6.4648 = 9.14
  EXPECT_EQ(t.helix_form_um, 10.0);              // 1.41421 x 7.2316 = 10.23
  EXPECT_EQ(t.total_helix_um, 14.0);             // hypot(9.1426, 10.2270) = 13.72
  EXPECT_EQ(t.runout_um, 26.0);                  // 0.9 x 28.80 = 25.92
}

TEST(FlankTolerance, DoublesEveryTwoClasses) {
  const FlankTolerances fine = flank_tolerances(size(), 9).value();
  const FlankTolerances coarse = flank_tolerances(size(), 11).value();
  EXPECT_NEAR(coarse.total_cumulative_pitch_um / fine.total_cumulative_pitch_um, 2.0, 0.02);
  EXPECT_NEAR(coarse.total_helix_um / fine.total_helix_um, 2.0, 0.03);
}

TEST(FlankTolerance, SmallValuesKeepATenthOfAMicrometre) {
  EXPECT_EQ(flank_tolerances(size(), 1).value().single_pitch_um, 1.6);  // 6.32 / 4 = 1.58
}

TEST(FlankTolerance, RefusesWhatTheStandardDoesNotCover) {
  const auto refused = [](ToleranceSize changed) {
    const auto result = flank_tolerances(changed, 7);
    return !result && result.error().code == ErrorCode::kOutOfRange;
  };
  ToleranceSize small_module = size(), few = size(), narrow = size(), steep = size(), little = size();
  small_module.normal_module_mm = 0.4;
  few.teeth = 4;
  narrow.face_width_mm = 3.9;
  steep.helix_angle_rad = rad_from_deg(46.0);
  little.reference_diameter_mm = 4.9;
  EXPECT_TRUE(refused(small_module));
  EXPECT_TRUE(refused(few));
  EXPECT_TRUE(refused(narrow));
  EXPECT_TRUE(refused(steep));
  EXPECT_TRUE(refused(little));
  EXPECT_FALSE(refused(size()));
  EXPECT_FALSE(flank_tolerances(size(), 0).has_value());
  EXPECT_FALSE(flank_tolerances(size(), 12).has_value());
}

}  // namespace
}  // namespace trueflank
