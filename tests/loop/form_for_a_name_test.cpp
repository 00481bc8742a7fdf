// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/made_gears.h"

// Courses that a name of one value follows most of the way, and a form with a place far better.
namespace trueflank::test {
namespace {

loop::LoopResult closed_on_some_teeth(const Process& made, double noise_um, unsigned seed) {
  const MadeGear gear = spur(23);
  return close(gear, inspection_of(gear, {made}, traced({1, 7, 13, 19}, noise_um, seed)));
}

// A deburring brush rounds the ends and leaves the middle flat: no crowning.
TEST(FormForAName, EndsThatABrushRoundsAreNoCrowning) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto made = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
      const double to_end_mm = 0.5 * g.face_mm * (1.0 - std::abs(s.v));
      return -6.0 * std::exp(-to_end_mm / 1.2);
    });
    const auto result = closed_on_some_teeth(made, 1.2, seed);
    EXPECT_EQ(find(result, "crowning"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "towards both ends")) << list(result);
  }
}

// Plating grows towards the tip edge: no pressure angle error.
TEST(FormForAName, PlatingThatGrowsAtTheTipIsNoPressureAngle) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto made =
        grown([](auto&, const FlankSpot& s, auto&) { return 6.0 * std::exp(-(1.0 - s.u) / 0.3); });
    const auto result = closed_on_some_teeth(made, 0.8, seed);
    EXPECT_EQ(find(result, "pressure_angle_error"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "towards the tip")) << list(result);
  }
}

// Of so many points forms are sought on some of them, and judged by all.
TEST(FormForAName, EndsThatABrushRoundsAreNoCrowningInALargeScan) {
  const MadeGear gear = spur(23);
  const auto made = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    return -6.0 * std::exp(-0.5 * g.face_mm * (1.0 - std::abs(s.v)) / 1.2);
  });
  const auto result = close(gear, scan_of(gear, {made}, scanned(330000, 12.0, 3)), true);
  EXPECT_EQ(find(result, "crowning"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "towards both ends")) << list(result);
}

TEST(FormForAName, WhatTheNamesSayKeepsThem) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto crowned = grown([](auto&, const FlankSpot& s, auto&) { return -7.0 * s.v * s.v; });
    expect_size(closed_on_some_teeth(crowned, 0.7, seed), "crowning", "amount_um", 7.0, 0.5);
    const auto leaning = grown([](auto&, const FlankSpot& s, auto&) { return 4.0 * s.u; });
    EXPECT_NE(find(closed_on_some_teeth(leaning, 0.7, seed), "pressure_angle_error"), nullptr);
  }
}

// Errors that hang together bend a slope near an end as far as chance goes: a kink there is a
// slope.
TEST(FormForAName, ATaperOfErrorsThatHangTogetherStaysOne) {
  const MadeGear gear = spur(18);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) { return 9.0 * s.v; });
  for (unsigned seed = 1; seed <= survey_size(8U, 24U); ++seed) {
    InspectionOptions options;
    options.noise_um = 0.8;
    options.correlation = 0.85;
    options.points = 30;
    options.seed = seed;
    const auto result = close(gear, inspection_of(gear, {made}, options));
    EXPECT_NE(find(result, "taper"), nullptr) << seed << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
