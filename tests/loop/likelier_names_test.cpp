// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

// Two names along the profile, chosen one after the other, may be imitated by the first.
namespace trueflank::test {
namespace {

bool is_told(const loop::LoopResult& result, const std::string& name) {
  return std::any_of(result.effects.begin(), result.effects.end(),
                     [&](const loop::FoundEffect& e) { return e.id == name; });
}

bool is_told_or_said(const loop::LoopResult& result, const std::string& name) {
  return is_told(result, name) ||
         std::any_of(result.effects.begin(), result.effects.end(), [&](const auto& e) {
           return std::find(e.confounded_with.begin(), e.confounded_with.end(), name) !=
                  e.confounded_with.end();
         });
}

/// A profile that leans, bows and is relieved from a share of its length on, by multiples of the
/// noise.
struct Profile {
  double slope_um = 0.0, bow_um = 0.0, relief_um = 0.0, from = 0.5;
};
Process made(const Profile& p) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    const double share = 0.5 * (s.u + 1.0);
    return 0.5 * p.slope_um * s.u - p.bow_um * s.u * s.u -
           p.relief_um * std::pow(std::max(share - p.from, 0.0) / (1.0 - p.from), 2);
  });
}

loop::LoopResult told(const MadeGear& gear, const Profile& profile, double noise_um,
                      unsigned seed) {
  const int z = gear.teeth;
  InspectionOptions options = traced({1, 1 + z / 4, 1 + z / 2, 1 + 3 * z / 4}, noise_um, seed);
  options.points = 64;
  return close(gear, inspection_of(gear, {made(profile)}, options));
}

TEST(LikelierNames, ALeanAndABowAreNoRelief) {
  const MadeGear gear = spur(33);
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto result = told(gear, {.slope_um = -24.0, .bow_um = 11.0}, 0.9, seed);
    expect_size(result, "pressure_angle_error", "slope_um", -24.0, 0.6);
    expect_size(result, "profile_crowning", "amount_um", 11.0, 0.6);
    EXPECT_FALSE(is_told(result, "tip_relief")) << list(result);
  }
}

// Small ones may look like one: then the answer says so.
TEST(LikelierNames, ALeanAndABowAreToldOrSaid) {
  const MadeGear gear = spur(33);
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto result = told(gear, {.slope_um = -9.0, .bow_um = 4.0}, 0.9, seed);
    for (const std::string name : {"pressure_angle_error", "profile_crowning"})
      EXPECT_TRUE(is_told_or_said(result, name)) << list(result);
  }
}

TEST(LikelierNames, ALeanBesideAReliefIsNoKink) {
  const MadeGear gear = spur(21);
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto result = told(gear, {.slope_um = -14.8, .relief_um = 8.9, .from = 0.7}, 1.1, seed);
    expect_size(result, "pressure_angle_error", "slope_um", -14.8, 2.0);
    expect_size(result, "tip_relief", "amount_um", 8.9, 2.0);
  }
}

TEST(LikelierNames, ABowBesideAWearIsNoGroove) {
  const MadeGear gear = spur(26);
  const auto worn = grown([](auto&, const FlankSpot& s, auto&) {
    return -12.0 * s.u * s.u - 10.0 * std::exp(-std::pow((s.u + 0.2) / 0.3, 2));
  });
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U})) {
    InspectionOptions options = traced({1, 8, 14, 20}, 0.8, seed);
    options.points = 64;
    const auto result = close(gear, inspection_of(gear, {worn}, options));
    expect_size(result, "profile_crowning", "amount_um", 12.0, 1.0);
    expect_size(result, "flank_wear", "depth_um", 10.0, 1.0);
  }
}

// What is left of an S beside a slope is no crowning with a relief.
TEST(LikelierNames, AnSGetsNoNames) {
  const MadeGear gear = spur(26);
  const auto s_shape =
      grown([](auto&, const FlankSpot& s, auto&) { return 3.0 * std::pow(s.u, 3); });
  for (const unsigned seed : {1U, 2U, 3U}) {
    InspectionOptions options = traced({1, 5, 9, 14, 18, 22}, 0.5, seed);
    options.points = 64;
    const auto result = close(gear, inspection_of(gear, {s_shape}, options));
    for (const char* name : {"profile_crowning", "tip_relief", "flank_wear"})
      EXPECT_FALSE(is_told(result, name)) << list(result);
  }
}

// A relief that begins near the root is a lean and a bow as well: the answer tells one and says the
// other.
TEST(LikelierNames, WhatFitsAsWellIsSaid) {
  const MadeGear gear = spur(26);
  int open = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto result = told(gear, {.relief_um = 4.0, .from = 0.22}, 1.2, seed);
    for (const loop::FoundEffect& e : result.effects)
      open += e.named && !e.confounded_with.empty() ? 1 : 0;
  }
  EXPECT_GE(open, 3);
}

}  // namespace
}  // namespace trueflank::test
