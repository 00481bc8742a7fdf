// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Whole sections that stand aside by an amount that changes with the height, feet of one side, play
// of an axis: each was told in many pieces, with names of causes that are not there.
namespace trueflank::test {
namespace {

/// Sections moved [um] by where they stand [mm], towards a direction and across it.
Process moved(const std::function<double(double)>& along, double deg,
              const std::function<double(double)>& across = {}) {
  return {.move_um = [=](const MadeGear& g, const FlankSpot& s, const Vec3&) -> Vec3 {
    const double a = deg * M_PI / 180.0, z_mm = 0.5 * (s.v + 1.0) * g.face_mm, off = along(z_mm),
                 aside = across ? across(z_mm) : 0.0;
    return {off * std::cos(a) - aside * std::sin(a), off * std::sin(a) + aside * std::cos(a), 0.0};
  }};
}
Process wobbling(double um, double wavelength_mm, double phase, double deg) {
  return moved([=](double z) { return um * std::cos(2.0 * M_PI * z / wavelength_mm + phase); },
               deg);
}

double tooth_rad(const MadeGear& g, const FlankSpot& s) {
  return 2.0 * M_PI * (s.tooth - 1) / g.teeth;
}

InspectionOptions of_all_teeth(double noise_um, unsigned seed) {
  InspectionOptions options;
  options.points = 60;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

TEST(SectionsInWaves, AreNoTiltAndNoLayerShift) {
  const MadeGear gear = spur(24);
  const auto wave = [&](double waves) { return wobbling(15.0, gear.face_mm / waves, 0.7, 42.0); };
  for (const auto& result :
       {close(gear, inspection_of(gear, {wave(3.0)}, of_all_teeth(1.5, 1))),
        close(gear, scan_of(gear, {wave(4.0)}, scanned(7000, 2.0, 2)), true)}) {
    EXPECT_FALSE(has_name(result)) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "whole sections stand aside in waves over the height"))
        << list(result);
    EXPECT_TRUE(tells(result, "towards 4")) << list(result);
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 15.0, 0.6);
  }
}

TEST(SectionsInWaves, ThatTurnAreOneForm) {
  const MadeGear gear = spur(24);
  const double length_mm = gear.face_mm / 2.7;
  const auto turns =
      moved([=](double z) { return 12.0 * std::cos(2.0 * M_PI * z / length_mm); }, 30.0,
            [=](double z) { return -12.0 * std::sin(2.0 * M_PI * z / length_mm); });
  const auto result = close(gear, scan_of(gear, {turns}, scanned(7000, 2.0, 3)), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_TRUE(tells(result, "all around, clockwise with the height")) << list(result);
}

TEST(SectionsInWaves, LeaveATiltAndAHelixErrorTheirNames) {
  const MadeGear gear = spur(24);
  const double face_mm = gear.face_mm;
  const auto leans = moved([=](double z) { return 24.0 * (z / face_mm - 0.5); }, -60.0);
  const auto turned = grown([](auto&, const FlankSpot& s, auto&) { return 9.0 * s.side * s.v; });
  const auto wave = wobbling(15.0, face_mm / 3.3, 2.0, 110.0);
  for (const auto& result :
       {close(gear, inspection_of(gear, {wave, leans, turned}, of_all_teeth(1.5, 4))),
        close(gear, scan_of(gear, {wave, leans, turned}, scanned(7000, 2.0, 4)), true)}) {
    EXPECT_EQ(result.effects.size(), 3U) << list(result);
    ASSERT_NE(find(result, "axis_tilt"), nullptr) << list(result);
    EXPECT_NEAR(parameter(*find(result, "axis_tilt"), "slope_um_per_mm").value, 24.0 / face_mm,
                1.2 / face_mm)
        << list(result);
    EXPECT_NE(find(result, "helix_error"), nullptr) << list(result);
  }
}

TEST(SectionsInSteps, AreLayerShiftsAndNoWave) {
  const MadeGear gear = spur(24);
  const double face_mm = gear.face_mm;
  const auto low = moved([=](double z) { return z > 0.3 * face_mm ? 14.0 : 0.0; }, 20.0),
             high = moved([=](double z) { return z > 0.65 * face_mm ? 11.0 : 0.0; }, 100.0),
             leans = moved([=](double z) { return 24.0 * (z / face_mm - 0.5); }, -60.0);
  const auto two = close(gear, scan_of(gear, {low, high}, scanned(7000, 2.0, 5)), true);
  EXPECT_EQ(two.effects.size(), 2U) << list(two);
  for (const auto& effect : two.effects) EXPECT_EQ(effect.id, "layer_shift") << list(two);
  const auto one = close(gear, scan_of(gear, {low, leans}, scanned(7000, 2.0, 6)), true);
  EXPECT_EQ(one.effects.size(), 2U) << list(one);
  EXPECT_NE(find(one, "layer_shift"), nullptr) << list(one);
  EXPECT_NE(find(one, "axis_tilt"), nullptr) << list(one);
}

TEST(KinkOfTheAxis, IsOneFormAndNoTiltWobbleOrLayerShift) {
  for (const MadeGear& gear : {spur(24), helical(27, 18.0)})
    for (const bool up : {true, false}) {
      if (!is_surveyed((gear.helix_rad == 0.0) == up)) continue;
      const double face_mm = gear.face_mm, at_mm = 0.45 * face_mm;
      const auto leans = moved(
          [=](double z) {
            return up ? 22.0 * std::max(0.0, z - at_mm) / (face_mm - at_mm)
                      : 22.0 * std::max(0.0, at_mm - z) / at_mm;
          },
          130.0);
      for (const auto& result :
           {close(gear, inspection_of(gear, {leans}, of_all_teeth(1.5, 11))),
            close(gear, scan_of(gear, {leans}, scanned(7000, 2.0, 12)), true)}) {
        EXPECT_FALSE(has_name(result)) << list(result);
        ASSERT_EQ(result.effects.size(), 1U) << list(result);
        EXPECT_TRUE(tells(result, "the axis of the teeth has a kink at a height of"))
            << list(result);
        EXPECT_TRUE(tells(result, up ? "straight below it" : "straight above it")) << list(result);
        EXPECT_TRUE(tells(result, "towards 1")) << list(result);
        const auto& kink = result.effects[0];
        EXPECT_NEAR(parameter(kink, "amplitude_um").value, 22.0, 1.0) << list(result);
      }
    }
}

TEST(KinkOfTheAxis, LeavesATiltALayerShiftAndABowWhatTheyAre) {
  const MadeGear gear = spur(24);
  const double face_mm = gear.face_mm;
  const auto leans = moved([=](double z) { return 24.0 * (z / face_mm - 0.5); }, -60.0);
  const auto shifts = moved([=](double z) { return z > 0.4 * face_mm ? 14.0 : 0.0; }, 20.0);
  const auto bends = moved([=](double z) { return 20.0 * z * z / (face_mm * face_mm); }, 75.0);
  for (const auto& [process, words] :
       {std::pair(leans, "axis_tilt"), std::pair(shifts, "layer_shift"),
        std::pair(bends, "the axis of the teeth is bent from the lower end on")})
    for (const auto& result :
         {close(gear, inspection_of(gear, {process}, of_all_teeth(1.5, 13))),
          close(gear, scan_of(gear, {process}, scanned(7000, 2.0, 14)), true)}) {
      EXPECT_EQ(result.effects.size(), 1U) << list(result);
      EXPECT_TRUE(tells(result, words)) << list(result);
    }
}

TEST(SoftShift, IsOneFormAndNoTiltWobbleOrLayerShift) {
  const MadeGear gear = spur(24);
  const double face_mm = gear.face_mm, half_mm = 0.12 * face_mm;
  struct Case {
    double at, to_both_sides;  ///< of the face; 1: those below go the other way, 0: they stay
  };
  const auto leans = moved([=](double z) { return 24.0 * (z / face_mm - 0.5); }, -60.0);
  for (const Case& c : {Case{0.5, 1.0}, Case{0.37, 0.0}}) {
    const double at_mm = c.at * face_mm;
    const auto slides = moved(
        [=](double z) {
          const double off = std::tanh((z - at_mm) / half_mm);
          return 16.0 * (c.to_both_sides > 0.0 ? off : 1.0 + off);
        },
        130.0);
    const auto expect_soft = [&](const loop::LoopResult& result) {
      EXPECT_TRUE(tells(result, "whole sections slide aside softly about a height of"))
          << list(result);
      EXPECT_TRUE(tells(result, "those above stand aside, towards 1")) << list(result);
      EXPECT_EQ(tells(result, "those below by as much the other way"), c.to_both_sides > 0.0)
          << list(result);
      EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value,
                  c.to_both_sides > 0.0 ? 16.0 : 32.0, 1.0)
          << list(result);
    };
    for (const auto& result :
         {close(gear, inspection_of(gear, {slides}, of_all_teeth(1.0, 21))),
          close(gear, scan_of(gear, {slides}, scanned(7000, 2.0, 22)), true)}) {
      EXPECT_FALSE(has_name(result)) << list(result);
      ASSERT_EQ(result.effects.size(), 1U) << list(result);
      expect_soft(result);
    }
    const auto beside = close(gear, scan_of(gear, {slides, leans}, scanned(7000, 2.0, 23)), true);
    ASSERT_EQ(beside.effects.size(), 2U) << list(beside);
    expect_soft(beside);
    ASSERT_NE(find(beside, "axis_tilt"), nullptr) << list(beside);
    EXPECT_NEAR(parameter(*find(beside, "axis_tilt"), "slope_um_per_mm").value, 24.0 / face_mm,
                2.0 / face_mm)
        << list(beside);
  }
}

// Beside an eccentricity the sections of helical teeth were taken to lean as a body, and a pitch
// wave made up for it.
TEST(TiltOfHelicalTeeth, LeavesNothingForAPitchWave) {
  std::mt19937_64 random(569);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low + (high - low) * uniform(random);
  };
  for (unsigned draw = 1; draw <= survey_size(3U, 10U); ++draw) {
    const MadeGear gear =
        helical(20 + static_cast<int>(12.0 * uniform(random)), between(12.0, 25.0));
    const double noise_um = 0.5, face_mm = gear.face_mm, tilt_um = between(4.0, 9.0),
                 off_um = between(2.0, 5.0), crown_um = between(1.5, 5.0),
                 lean_um = between(2.0, 6.0);
    const auto leans = moved([=](double z) { return tilt_um * (z / face_mm - 0.5); },
                             between(0.0, 360.0)),
               off = moved([=](double) { return off_um; }, between(0.0, 360.0));
    const auto both = grown(
        [=](auto&, const FlankSpot& s, auto&) { return lean_um * s.u - crown_um * s.v * s.v; });
    const auto result =
        close(gear, inspection_of(gear, {leans, off, both}, of_all_teeth(noise_um, draw)));
    SCOPED_TRACE(list(result));
    EXPECT_EQ(result.effects.size(), 4U);
    expect_size(result, "axis_tilt", "slope_um_per_mm", tilt_um / face_mm,
                0.05 * tilt_um / face_mm);
    expect_size(result, "eccentricity", "amplitude_um", off_um, 0.1 * off_um);
  }
}

// A step over the middle of the face took the tips out of the data; then a scale, by which they
// stand a quarter of a millimetre off, was told for teeth that are too thick.
TEST(LayerShift, LeavesTheTipsTheirSay) {
  const MadeGear gear = spur(16);
  for (unsigned draw = 1; draw <= survey_size(2U, 6U); ++draw) {
    const double at_mm = (0.33 + 0.06 * draw) * gear.face_mm, shift_um = 90.0, thick_um = 40.0;
    const auto shift = moved([=](double z) { return z > at_mm ? shift_um : 0.0; }, 60.0 * draw);
    const auto thick = grown([=](auto&, auto&, auto&) { return thick_um; });
    const auto leans = grown([](auto&, const FlankSpot& s, auto&) { return 20.0 * s.u; });
    loop::ScanData scan = scan_of(gear, {shift, thick, leans}, scanned(6000, 6.0, draw)), tips;
    add_tips(gear, 0.0, tips);
    for (Vec3& p : tips.points_mm)
      if (p[2] > at_mm) {
        p[0] += 1e-3 * shift_um * std::cos(60.0 * draw * M_PI / 180.0);
        p[1] += 1e-3 * shift_um * std::sin(60.0 * draw * M_PI / 180.0);
      }
    scan.points_mm.insert(scan.points_mm.end(), tips.points_mm.begin(), tips.points_mm.end());
    const auto result = close(gear, scan, true);
    SCOPED_TRACE(list(result));
    EXPECT_EQ(find(result, "scale"), nullptr);
    EXPECT_EQ(result.not_observable, std::vector<std::string>{});
    expect_size(result, "tooth_thickness", "amount_um",
                2.0 * thick_um / std::cos(gear.pressure_angle_rad), 4.0);
  }
}

TEST(FootOfOneSide, IsOneFormAndNoFoot) {
  const MadeGear gear = spur(30);
  const auto foot = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    const double z = 0.5 * (s.v + 1.0);
    return 10.0 * std::exp(-z / 0.09) * (1.0 + std::cos(tooth_rad(g, s) - 2.0));
  });
  const auto result = close(gear, scan_of(gear, {foot}, scanned(9000, 1.5, 1)), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_TRUE(tells(result, "dies away from the lower end within")) << list(result);
  EXPECT_TRUE(tells(result, "most on the teeth towards 11")) << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 20.0, 1.0);
}

TEST(FootOfOneSide, BesideAFootOfAllTeethLeavesItItsName) {
  const MadeGear gear = spur(30);
  const auto feet = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    const double z = 0.5 * (s.v + 1.0);
    return std::exp(-z / 0.09) * (14.0 + 8.0 * (1.0 + std::cos(tooth_rad(g, s) + 0.5)));
  });
  const auto result = close(gear, scan_of(gear, {feet}, scanned(9000, 1.5, 2)), true);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
  ASSERT_NE(find(result, "elephant_foot"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "dies away from the lower end within")) << list(result);
}

TEST(PlayOfAnAxis, IsOneFormAndLeavesAPressureAngleItsName) {
  const MadeGear gear = spur(34);
  const Process play{.move_um = [](const MadeGear& g, const FlankSpot& s, const Vec3&) -> Vec3 {
    return {normal_at(g, s)[1] < 0.0 ? 8.0 : -8.0, 0.0, 0.0};
  }};
  const auto leans = grown([](auto&, const FlankSpot& s, auto&) { return 2.5 * s.u; });
  for (const auto& result :
       {close(gear, inspection_of(gear, {play, leans}, of_all_teeth(1.0, 1))),
        close(gear, scan_of(gear, {play, leans}, scanned(7000, 1.5, 1)), true)}) {
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
    EXPECT_TRUE(tells(result, "displaced along x")) << list(result);
    EXPECT_NE(find(result, "pressure_angle_error"), nullptr) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
