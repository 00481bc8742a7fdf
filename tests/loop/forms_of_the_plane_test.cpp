// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/loop/one_drawn_form.h"

// Forms of the transverse plane, the same at all heights: strips, half planes, discs, stripes.
namespace trueflank::test {
namespace {

Draw draw_in_plane(unsigned seed) { return Draw(seed * 6271U + 29U); }

/// Walls too thick by this where a place of the plane lies so.
template <class Inside>
Process thicker_where(double um, const Inside& inside) {
  return grown([=](const MadeGear&, const FlankSpot&, const Vec3& p) {
    return inside(p[0], p[1]) ? um : 0.0;
  });
}

/// A bound within what points that lie so far apart tell.
void expect_bound(const loop::LoopResult& result, std::size_t k, double mm, double within) {
  EXPECT_NEAR(result.effects.front().terms.front().shape[k], mm, within) << list(result);
}

TEST(PartOfThePlane, AStripIsNoSingleTooth) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    Draw draw = draw_in_plane(seed);
    const MadeGear gear = spur(draw.whole(24, 44));
    const double um = draw.sign() * draw.between(18.0, 45.0),
                 middle = draw.between(0.1, 0.6) * gear.tip_mm,
                 half = draw.between(0.09, 0.2) * gear.tip_mm;
    const bool along_y = draw.whole(0, 1) == 1;
    const auto made = thicker_where(
        um, [=](double x, double y) { return std::abs((along_y ? y : x) - middle) < half; });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 4.0, seed)), true);
    expect_one_of_size(result, std::abs(um), 0.06);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_TRUE(tells(result, "at all heights")) << list(result);
  }
}

TEST(PartOfThePlane, WhatLiesBeyondABoundIsOneForm) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = draw_in_plane(100U + seed);
    const MadeGear gear = spur(draw.whole(20, 40));
    const double um = draw.sign() * draw.between(18.0, 45.0),
                 beyond = draw.between(0.1, 0.7) * gear.tip_mm, towards = draw.between(-3.1, 3.1);
    const auto made = thicker_where(um, [=](double x, double y) {
      return x * std::cos(towards) + y * std::sin(towards) > beyond;
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 4.0, seed)), true);
    expect_one_of_size(result, std::abs(um), 0.06);
    if (::testing::Test::HasFatalFailure()) return;
    EXPECT_TRUE(tells(result, um > 0.0 ? "the flanks stand out" : "the flanks lie back"))
        << list(result);
    expect_bound(result, 2, beyond, 0.02 * gear.tip_mm);
  }
}

TEST(PartOfThePlane, ADiscIsOneForm) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    Draw draw = draw_in_plane(200U + seed);
    const MadeGear gear = spur(draw.whole(24, 40));
    const double um = draw.sign() * draw.between(20.0, 45.0), towards = draw.between(-3.1, 3.1),
                 off = draw.between(0.8, 1.0) * gear.tip_mm,
                 radius = draw.between(0.3, 0.55) * gear.tip_mm;
    const auto made = thicker_where(um, [=](double x, double y) {
      return std::hypot(x - off * std::cos(towards), y - off * std::sin(towards)) < radius;
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(6000, 4.0, seed)), true);
    // (its edge, between points of few flanks, may leave something that is said to be left)
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NEAR(amplitude_of_first(result), std::abs(um), 0.06 * std::abs(um)) << list(result);
    EXPECT_FALSE(has_name(result)) << list(result);
    EXPECT_TRUE(tells(result, "in a disc of the plane")) << list(result);
  }
}

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
    expect_bound(result, 1, length, 0.01 * length);
  }
}

}  // namespace
}  // namespace trueflank::test
