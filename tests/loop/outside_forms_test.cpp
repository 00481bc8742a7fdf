// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/gear/effects/registry.h"

// Forms that a judge from outside hid, beside a name: each was told as many waves, steps, grooves
// or single teeth, some with names.
namespace trueflank::test {
namespace {

TEST(SectorBesideEccentricity, IsOneSectorAndTheEccentricityKeepsItsSize) {
  const MadeGear gear = spur(41);
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const int first = 5 + 9 * static_cast<int>(seed), count = 6 + 3 * static_cast<int>(seed);
    const auto thick = [&](auto&, const FlankSpot& s, auto&) {
      return (s.tooth - first + gear.teeth) % gear.teeth < count ? 9.0 : 0.0;
    };
    const auto result =
        close(gear, scan_of(gear, {off_centre(8.0, 40.0), grown(thick)}, scanned(12000, 2.0, seed)),
              true);
    ASSERT_NE(find(result, "eccentricity"), nullptr) << list(result);
    EXPECT_NEAR(parameter(*find(result, "eccentricity"), "amplitude_um").value, 8.0, 0.3)
        << list(result);
    EXPECT_TRUE(tells(result, "a sector of " + std::to_string(count) + " teeth from tooth " +
                                  std::to_string(first) + " on stands out on both flanks"))
        << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
  }
}

TEST(SectorBesideEccentricity, LobesAreNoSector) {
  const MadeGear gear = spur(41);
  const auto result = close(gear,
                            scan_of(gear,
                                    {out_of_round(2, 6.0, 20.0), out_of_round(3, 5.0, 70.0),
                                     out_of_round(5, 4.0, 10.0), off_centre(8.0, 40.0)},
                                    scanned(12000, 2.0, 4)),
                            true);
  EXPECT_FALSE(tells(result, "sector")) << list(result);
  EXPECT_FALSE(tells(result, "swelling")) << list(result);
}

TEST(HalvesTurned, AreOneStepToOppositeSides) {
  const MadeGear gear = spur(31);
  const auto turned = [](auto&, const FlankSpot& s, auto&) {
    return s.v > -0.2 ? 7.0 * s.side : 0.0;
  };
  const auto crowned = [](auto&, const FlankSpot& s, auto&) { return -12.0 * s.v * s.v; };
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const auto traces = close(
        gear,
        inspection_of(gear, {grown(turned)}, traced({1, 5, 9, 13, 17, 21, 25, 28}, 1.2, seed)));
    const auto scan = close(
        gear, scan_of(gear, {grown(turned), grown(crowned)}, scanned(9000, 1.5, seed)), seed > 1);
    for (const auto* result : {&traces, &scan}) {
      const std::string text = list(*result), words = "a step over the face at a height of ";
      ASSERT_NE(text.find(words), std::string::npos) << text;
      // (values of a trace stand 0.08 mm apart)
      EXPECT_NEAR(std::stod(text.substr(text.find(words) + words.size())), 4.0, 0.08) << text;
      EXPECT_TRUE(tells(*result, ", opposite on the two flanks")) << list(*result);
      EXPECT_EQ(result->effects.size(), result == &scan ? 2U : 1U) << list(*result);
    }
    EXPECT_NE(find(scan, "crowning"), nullptr) << list(scan);
  }
}

TEST(CombOfOneFlank, HasAMeanThatIsNoThickness) {
  const MadeGear gear = spur(32);
  const auto comb = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 && s.tooth % 2 == 0 ? 8.0 : 0.0;
  };
  const auto thick = [](auto&, const FlankSpot&, auto&) { return 9.0; };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto alone = close(gear, scan_of(gear, {grown(comb)}, scanned(5000, 1.5, seed)), true);
    EXPECT_TRUE(tells(alone, "every other tooth")) << list(alone);
    EXPECT_FALSE(has_name(alone)) << list(alone);
    // More than a comb can have is one.
    const auto both =
        close(gear, scan_of(gear, {grown(comb), grown(thick)}, scanned(5000, 1.5, seed)), true);
    EXPECT_TRUE(has_name(both)) << list(both);
  }
}

TEST(WornCorner, IsOneFormOfItsFlankBesideATaper) {
  const MadeGear gear = helical(29, 14.0);
  for (const double power : survey_of(1, {1.0, 2.0})) {
    const auto corner = [&](auto&, const FlankSpot& s, auto&) {
      const double on = s.side > 0 ? std::max(0.0, s.u - s.v - 0.5) / 1.5 : 0.0;
      return -18.0 * std::pow(on, power) + 7.0 * s.v;
    };
    const auto result = close(gear, scan_of(gear, {grown(corner)}, scanned(7000, 1.1, 3)), true);
    EXPECT_TRUE(tells(result, "the corner at the tip and the lower end lies back"))
        << power << " " << list(result);
    ASSERT_NE(find(result, "taper"), nullptr) << power << " " << list(result);
    EXPECT_NEAR(parameter(*find(result, "taper"), "slope_um").value, 14.0, 0.5)
        << power << " " << list(result);
    EXPECT_LE(result.effects.size(), 3U) << power << " " << list(result);
  }
}

TEST(WornCorner, ATwistBesideACrowningIsNone) {
  const MadeGear gear = helical(29, 14.0);
  const auto twisted = [](auto&, const FlankSpot& s, auto&) {
    return 6.0 * s.u * s.v - 8.0 * s.v * s.v;
  };
  const auto result = close(gear, scan_of(gear, {grown(twisted)}, scanned(14000, 1.6, 3)), true);
  EXPECT_FALSE(tells(result, "corner")) << list(result);
  EXPECT_NE(find(result, "crowning"), nullptr) << list(result);
}

TEST(RoundedEnds, AreOneFormBesideACrowning) {
  const MadeGear gear = spur(37);
  const auto rounded = [](auto&, const FlankSpot& s, auto&) {
    const double beyond = std::max(0.0, (std::abs(s.v) - 0.85) / 0.15);
    return -14.0 * beyond * beyond - 9.0 * s.v * s.v;
  };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result =
        close(gear, scan_of(gear, {grown(rounded)}, scanned(6000, 1.1, seed)), true);
    ASSERT_NE(find(result, "crowning"), nullptr) << list(result);
    EXPECT_NEAR(parameter(*find(result, "crowning"), "amount_um").value, 9.0, 0.6) << list(result);
    EXPECT_TRUE(tells(result, "and as far from the other end")) << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(LayerShift, StandsClearlyWithinTheFace) {
  const auto geometry = geometry_of(spur(24));
  for (const loop::EffectFamily& family : loop::effect_library()) {
    if (family.id != "layer_shift") continue;
    const auto [low, high] = family.shape_limits(geometry, 0);
    EXPECT_GE(low, 0.02 * geometry.face_width_mm());
    EXPECT_LE(high, 0.98 * geometry.face_width_mm());
  }
}

TEST(NamesThatMayBeNothing, AreNotTold) {
  // Few traces, errors that hang together: what a form leaves of a slope is within its own error.
  const MadeGear gear = spur(60);
  const auto rounded = [](auto&, const FlankSpot& s, auto&) {
    const double beyond = std::max(0.0, (std::abs(s.v) - 0.8) / 0.2);
    return -17.0 * beyond * beyond;
  };
  for (unsigned seed = 1; seed <= survey_size(4U, 12U); ++seed) {
    InspectionOptions options = traced({1, 11, 21, 31, 41, 51}, 2.3, seed);
    options.points = 63;
    options.correlation = 0.56;
    const auto result = close(gear, inspection_of(gear, {grown(rounded)}, options));
    for (const auto& effect : result.effects)
      if (effect.named && effect.parameters.size() == 1) {
        EXPECT_TRUE(effect.parameters[0].low > 0.0 || effect.parameters[0].high < 0.0)
            << list(result);
      }
  }
}

TEST(AnyPose, WhatHangsOnItIsNotCorrected) {
  const MadeGear gear = spur(30);
  const auto leads = [](auto&, const FlankSpot& s, auto&) {
    return 6.0 * s.v * s.side * std::cos(2.0 * 2.0 * M_PI * s.tooth / 30.0);
  };
  const auto leaning = [](auto&, const FlankSpot& s, auto&) { return 5.0 * s.u; };
  const auto crowned = [](auto&, const FlankSpot& s, auto&) { return -9.0 * s.v * s.v; };
  const auto tapered = [](auto&, const FlankSpot& s, auto&) { return 5.0 * s.v; };
  for (const bool aligned : {false, true}) {
    ScanOptions options = scanned(12000, 0.8, 3);
    options.any_pose = !aligned;
    const auto result = close(
        gear,
        scan_of(gear, {grown(leads), grown(leaning), grown(crowned), grown(tapered)}, options),
        aligned);
    const auto is_left = [](const loop::FoundEffect& e) { return !e.not_corrected.empty(); };
    for (const auto& effect : result.effects) {
      const bool hangs = effect.id != "pressure_angle_error" && effect.id != "crowning";
      EXPECT_EQ(is_left(effect), hangs && !aligned) << effect.id << " " << list(result);
      EXPECT_EQ(effect.correctable && effect.named, effect.named && (aligned || !hangs))
          << effect.id << " " << list(result);
    }
    ASSERT_NE(find(result, "pressure_angle_error"), nullptr) << list(result);
    ASSERT_NE(find(result, "taper"), nullptr) << list(result);
    const auto correction = loop::Correction::make(loop_json(result), geometry_of(gear));
    ASSERT_TRUE(correction.has_value()) << correction.error().message;
    const auto count = static_cast<std::size_t>(
        std::count_if(result.effects.begin(), result.effects.end(), is_left));
    EXPECT_EQ(correction->left().size(), count) << list(result);
    EXPECT_EQ(count > 0, !aligned) << list(result);
  }
}

TEST(AnyPose, AFootSaysWhichEndIsUp) {
  const MadeGear gear = spur(30);
  const auto foot = [](auto&, const FlankSpot& s, auto&) {
    return 40.0 * std::exp(-0.5 * (s.v + 1.0) * 10.0 / 0.6) + 3.0 * s.v;
  };
  ScanOptions options = scanned(16000, 0.8, 3);
  options.any_pose = true;
  const auto result = close(gear, scan_of(gear, {grown(foot)}, options), false);
  for (const auto& effect : result.effects)
    if (find(result, "elephant_foot") != nullptr) {
      EXPECT_EQ(effect.not_corrected, "") << list(result);
    } else {
      EXPECT_NE(effect.not_corrected, "") << list(result);
    }
  EXPECT_FALSE(result.effects.empty());
}

}  // namespace
}  // namespace trueflank::test
