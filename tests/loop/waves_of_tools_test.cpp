// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "tests/loop/made_gears.h"

// Waves over the profile that every tooth has alike, as a tool leaves them that runs out: mirrored
// on the two flanks, of one base pitch or of any length.
namespace trueflank::test {
namespace {

double roll_mm(const MadeGear& g, const FlankSpot& s) {
  const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
  return from + 0.5 * (s.u + 1.0) * (to - from);
}
double base_pitch_mm(const MadeGear& g) { return 2.0 * M_PI * g.base() / g.teeth; }

double wave(const MadeGear& g, const FlankSpot& s, double length_mm, double phase_rad) {
  return std::cos(2.0 * M_PI * roll_mm(g, s) / length_mm + s.side * phase_rad);
}

// The order of the teeth is a wave over the face, too, where the teeth are helical: the helix
// traces say that there is none.
TEST(WavesOfTools, OnTracesOfAHelicalGearAreNoMachinesOrder) {
  const MadeGear gear = helical(42, -26.0);
  for (const double phase_rad : {2.1, 1.07, 0.3}) {
    const auto made = [=](const MadeGear& g, const FlankSpot& s, auto&) {
      return 2.0 * wave(g, s, base_pitch_mm(g), phase_rad);
    };
    const auto result =
        close(gear, inspection_of(gear, {grown(made)}, traced({1, 11, 22, 32}, 0.25, 41)));
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "waves over the profile")) << list(result);
    EXPECT_TRUE(tells(result, "mirrored on the two flanks")) << list(result);
  }
}

TEST(WavesOfTools, OfTheOrderOfTheTeethOnProfilesAloneAreNoMachinesOrder) {
  for (const auto& [z, teeth, phase_rad] :
       {std::tuple{49, std::vector<int>{1, 9, 17, 25, 33, 41}, -2.4},
        std::tuple{79, std::vector<int>{1, 27, 53}, -0.29}}) {
    const MadeGear gear = spur(z);
    InspectionOptions options = traced(teeth, 1.0, 42);
    options.helix = false;
    const auto made = [phase = phase_rad](const MadeGear& g, const FlankSpot& s, auto&) {
      return 6.0 * wave(g, s, base_pitch_mm(g), phase);
    };
    const auto result = close(gear, inspection_of(gear, {grown(made)}, options));
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "mirrored on the two flanks")) << list(result);
  }
}

// The relief beside it has its name and its size.
TEST(WavesOfTools, StandBesideARelief) {
  const MadeGear gear = spur(31);
  const auto result =
      close(gear,
            scan_of(gear, {grown([](const MadeGear& g, const FlankSpot& s, auto&) {
                      const double past = std::max(0.0, (0.5 * (s.u + 1.0) - 0.6) / 0.4);
                      return 9.0 * wave(g, s, 0.93 * base_pitch_mm(g), 0.6) - 14.0 * past * past;
                    })},
                    scanned(4000, 1.5, 43)),
            true);
  expect_size(result, "tip_relief", "amount_um", 14.0, 1.0);
  EXPECT_TRUE(tells(result, "mirrored on the two flanks")) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

/// Arches of feed marks with sharp grooves between them, inclined over the profile.
Process scallops(double depth_um, double over_profile, double over_face) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    const double waves = 0.5 * (over_profile * (s.u + 1.0) + over_face * (s.v + 1.0)) + 0.3;
    return depth_um * std::abs(std::sin(M_PI * waves));
  });
}

// Each flank had waves of its own, and each wave its multiples.
TEST(Scallops, OfAScanAreOneFormOfBothFlanks) {
  const auto result =
      close(spur(26), scan_of(spur(26), {scallops(14.0, 0.8, 4.3)}, scanned(5000, 1.5, 44)), true);
  EXPECT_TRUE(tells(result, "scallops with sharp grooves between them")) << list(result);
  EXPECT_TRUE(tells(result, "0.8 over the profile")) << list(result);
  EXPECT_TRUE(tells(result, "4.3 over the face")) << list(result);
  EXPECT_LE(result.effects.size(), 2U) << "(and by how much all flanks stand out)" << list(result);
}

// A profile trace shows a part of a wave: it was a kink, or a crowning.
TEST(Scallops, OfTracesHaveTheirInclination) {
  const MadeGear gear = spur(33);
  const auto result =
      close(gear, inspection_of(gear, {scallops(5.0, -0.6, 5.2)}, traced({1, 12, 23}, 0.3, 45)));
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_TRUE(tells(result, "scallops with sharp grooves between them")) << list(result);
  EXPECT_TRUE(tells(result, "rising towards the tip")) << list(result);
}

}  // namespace
}  // namespace trueflank::test
