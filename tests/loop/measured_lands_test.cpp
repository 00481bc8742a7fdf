// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"

// Tips of a part that grew stand where the design has flanks.
namespace trueflank::test {
namespace {

/// Points of the tip lands, scaled with the part.
void add_tips(const MadeGear& gear, double percent, loop::ScanData& scan) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const FlankSpot end{1, 1, 1.0, -1.0};
  const Vec3 corner = point_on(gear, end);
  const double half = std::abs(std::atan2(corner[1], corner[0]));
  const double grown = 1.0 + 0.01 * percent;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2.0 * M_PI * (i % gear.teeth) / gear.teeth + half * share(random);
    const double r = gear.tip_mm * grown + 0.004 * share(random);
    scan.points_mm.push_back({r * std::cos(angle), r * std::sin(angle),
                              0.5 * gear.face_mm * grown * (1.0 + 0.98 * share(random))});
  }
}

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
