// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"

// Tips of a part that grew stand where the design has flanks.
namespace trueflank::test {
namespace {

TEST(MeasuredLands, TipsOfAGrownRingAreNoRelief) {
  const MadeGear gear = ring(72);
  for (const double percent : {0.4, -0.4}) {
    auto scan = scan_of(gear, {scaled(percent)}, {.points = 12000, .noise_um = 4.0});
    add_tips(gear, percent, scan);
    const auto result = close(gear, scan, true);
    ASSERT_EQ(result.effects.size(), 1u) << list(result);
    EXPECT_EQ(result.effects[0].id, "scale");
    EXPECT_NEAR(parameter(result.effects[0], "percent").value, percent, 0.01);
    EXPECT_LT(result.after.held_out_rms, 4.4);
  }
}

TEST(MeasuredLands, TipsOfAShrunkGearAreNoRelief) {
  const MadeGear gear = spur(90);
  auto scan = scan_of(gear, {scaled(-0.6)}, {.points = 12000, .noise_um = 4.0});
  add_tips(gear, -0.6, scan);
  const auto result = close(gear, scan, true);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "scale");
  EXPECT_NEAR(parameter(result.effects[0], "percent").value, -0.6, 0.01);
}

}  // namespace
}  // namespace trueflank::test
