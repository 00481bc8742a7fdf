// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/loop/one_drawn_form.h"

// Forms of the transverse plane, the same at all heights.
namespace trueflank::test {
namespace {

Draw draw_in_plane(unsigned seed) { return Draw(seed * 6271U + 29U); }

TEST(StripesOfThePlane, InAnyDirectionAreOneForm) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    Draw draw = draw_in_plane(300U + seed);
    const MadeGear gear = spur(draw.whole(20, 40));
    const double um = draw.between(14.0, 40.0), towards = draw.between(0.0, std::numbers::pi),
                 length = 2.0 * gear.tip_mm / draw.between(2.5, 8.0),
                 phase = draw.between(0.0, 6.28);
    const auto made = grown([=](const MadeGear&, const FlankSpot&, const Vec3& p) {
      const double along = p[0] * std::cos(towards) + p[1] * std::sin(towards);
      return um * std::cos(2.0 * std::numbers::pi * along / length + phase);
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 4.0, seed)), true);
    expect_one_of_size(result, um, 0.05);
    if (::testing::Test::HasFatalFailure()) return;
    EXPECT_TRUE(tells(result, "in stripes of the plane")) << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().shape[1], length, 0.01 * length)
        << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
