// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/made_gears.h"

// Forms by a direction: what a flank faces, where a place lies at an end of the teeth. Slopes of
// the two flanks, waves that are not alike all over, waves of one trace.
namespace trueflank::test {
namespace {

double direction_rad(const Vec3& p) { return std::atan2(p[1], p[0]); }
double towards_rad(double deg) { return deg * M_PI / 180.0; }

loop::LoopResult scan_with(const MadeGear& gear, const Process& process, double noise_um,
                           unsigned seed) {
  return close(gear, scan_of(gear, {process}, scanned(9000, noise_um, seed)), true);
}

void expect_one(const loop::LoopResult& result, const std::string& words) {
  EXPECT_TRUE(tells(result, words)) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
}

TEST(FacingDirection, OfTheFlanksIsOneForm) {
  const auto by_facing = [](const MadeGear& g, const FlankSpot& s, const Vec3&) {
    const Vec3 n = normal_at(g, s);
    return 6.0 * std::cos(2.0 * (std::atan2(n[1], n[0]) - towards_rad(40.0)));
  };
  for (const MadeGear& gear : survey_of(1, {helical(31, 18.0), spur(26)}))
    expect_one(scan_with(gear, grown(by_facing), 1.5, 3),
               "by the direction that they face, twice per turn, at 40 deg first");
}

TEST(FacingDirection, OfOneSideIsOneForm) {
  const auto one_side = [](const MadeGear& g, const FlankSpot& s, const Vec3&) {
    const Vec3 n = normal_at(g, s);
    const double faced = std::cos(std::atan2(n[1], n[0]) - towards_rad(200.0));
    return 12.0 * std::pow(std::max(faced, 0.0), 2);
  };
  const MadeGear gear = spur(28);
  expect_one(scan_with(gear, grown(one_side), 1.5, 4),
             "flanks that face towards 200 deg stand out");
}

TEST(FacingDirection, OfOneSideAndMoreAndMoreTowardsAnEndIsOneForm) {
  for (const bool up : survey_of(1, {true, false})) {
    const auto fan = [up](const MadeGear& g, const FlankSpot& s, const Vec3&) {
      const Vec3 n = normal_at(g, s);
      const double faced = std::cos(std::atan2(n[1], n[0]) - towards_rad(200.0));
      return 30.0 * std::max(faced, 0.0) * 0.5 * (1.0 + (up ? s.v : -s.v));
    };
    const MadeGear gear = up ? spur(26) : helical(23, 14.0);
    const auto result = scan_with(gear, grown(fan), 3.0, 6);
    expect_one(result, "walls that face towards ");
    EXPECT_TRUE(tells(result, up ? "towards the upper end" : "towards the lower end"))
        << list(result);
    ASSERT_FALSE(result.effects.empty());
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 30.0, 2.5) << list(result);
  }
}

TEST(SwellingsAtAnEnd, AreOneForm) {
  const MadeGear gear = spur(32);
  for (const int number : survey_of(1, {2, 4})) {
    const auto bulges = [&](const MadeGear& g, const FlankSpot& s, const Vec3& p) {
      const double off = std::remainder(direction_rad(p) - towards_rad(30.0), 2.0 * M_PI / number);
      return -12.0 * std::exp(-std::pow(off / towards_rad(15.0), 2)) *
             std::exp(-0.5 * (s.v + 1.0) * g.face_mm / (0.16 * g.face_mm));
    };
    // (as swellings at an end, or as places of the body with that course: the same form)
    const auto result = scan_with(gear, grown(bulges), 1.5, 5);
    expect_one(result, std::to_string(number) + " hollows");
    EXPECT_TRUE(tells(result, "evenly spaced around the gear")) << list(result);
    EXPECT_TRUE(tells(result, "lower end")) << list(result);
  }
}

TEST(SlopesOfBothFlanks, AreALeanAndATaper) {
  const auto sloped = [](double left_um, double right_um) {
    return grown([=](auto&, const FlankSpot& s, auto&) {
      return 0.5 * s.v * (s.side > 0 ? left_um : -right_um);
    });
  };
  for (const MadeGear& gear : {spur(24), helical(29, -20.0)}) {
    const auto both =
        close(gear, inspection_of(gear, {sloped(4.0, -18.0)}, traced({1, 7, 13, 19}, 1.0, 6)));
    ASSERT_NE(find(both, "taper"), nullptr) << list(both);
    ASSERT_NE(find(both, "helix_error"), nullptr) << list(both);
    EXPECT_NEAR(parameter(*find(both, "taper"), "slope_um").value, 11.0, 0.6) << list(both);
    EXPECT_NEAR(parameter(*find(both, "helix_error"), "slope_um").value, -7.0, 0.6) << list(both);
    const auto one =
        close(gear, inspection_of(gear, {sloped(0.0, -18.0)}, traced({1, 7, 13, 19}, 1.0, 7)));
    ASSERT_EQ(one.effects.size(), 1U) << list(one);
    EXPECT_EQ(one.effects[0].id, "helix_error") << list(one);
    EXPECT_NE(one.effects[0].flank, "both") << list(one);
  }
}

TEST(WavesThatChange, AreOneForm) {
  const MadeGear gear = spur(22);
  const auto share = [](const FlankSpot& s) { return 0.5 * (s.v + 1.0); };
  const auto shorter = [&](auto&, const FlankSpot& s, auto&) {
    const double x = share(s);
    return 6.0 * std::cos(2.0 * M_PI * 5.5 * (x + 0.3 * (x * x - x)) + 0.8);
  };
  const auto growing = [&](auto&, const FlankSpot& s, auto&) {
    return 9.0 * share(s) * std::cos(2.0 * M_PI * 4.3 * share(s) + 0.4);
  };
  const InspectionOptions options = traced({1, 6, 12, 17}, 1.0, 8);
  expect_one(close(gear, inspection_of(gear, {grown(shorter)}, options)),
             "waves over the face that change their length");
  expect_one(close(gear, inspection_of(gear, {grown(growing)}, options)),
             "that grow evenly towards the upper end");
}

TEST(WalkingWaves, OfNoWholeNumberATurnThatBothFlanksShareAreOneForm) {
  const MadeGear gear = spur(25);
  const auto chatter = [](auto&, const FlankSpot& s, auto&) {
    return 5.0 * std::cos(M_PI * 3.2 * (s.u + 1.0) + towards_rad(66.0) * s.tooth);
  };
  InspectionOptions options = traced({}, 1.0, 9);
  options.points = 60;
  const auto result = close(gear, inspection_of(gear, {grown(chatter)}, options));
  EXPECT_TRUE(tells(result, "4.58 periods a turn") || tells(result, "4.59 periods a turn"))
      << list(result);
  EXPECT_TRUE(tells(result, "begin anew at tooth 1,")) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

TEST(WavesOfOneTrace, AreAFormOfItsTooth) {
  const MadeGear gear = spur(20);
  for (const int tooth : {1, 6, 11, 16}) {
    const auto shaken = [=](auto&, const FlankSpot& s, auto&) {
      return s.tooth == tooth && s.side > 0 ? 8.0 * std::cos(M_PI * 6.3 * (s.v + 1.0)) : 0.0;
    };
    const auto result =
        close(gear, inspection_of(gear, {grown(shaken)}, traced({1, 6, 11, 16}, 1.0, 10)));
    expect_one(result, "on tooth " + std::to_string(tooth) + " alone, 6.3 waves over the face");
    // (whether that tooth is held out or not)
    EXPECT_LT(result.after.held_out_rms, 1.3) << tooth;
  }
}

// The screw of an axis: every place of a coordinate is shifted alike.
TEST(PlaneWave, OfAScrewIsOneForm) {
  const MadeGear gear = spur(33);
  for (const bool along_y : {false, true})
    for (const double wavelength_mm : {4.3, 11.0}) {
      const Process screw{.move_um = [=](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
        const double um = 14.0 * std::cos(2.0 * M_PI * p[along_y ? 1 : 0] / wavelength_mm - 0.7);
        return {along_y ? 0.0 : um, along_y ? um : 0.0, 0.0};
      }};
      const auto result = close(gear, scan_of(gear, {screw}, scanned(9000, 3.0, 35)), true);
      const std::string axis = along_y ? "y" : "x";
      EXPECT_TRUE(tells(result, "places are shifted along " + axis + " in waves over " + axis))
          << wavelength_mm << ": " << list(result);
      ASSERT_EQ(result.effects.size(), 1U) << list(result);
      EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 14.0, 0.5) << list(result);
      EXPECT_NEAR(result.effects[0].terms.front().shape[2], wavelength_mm, 0.01 * wavelength_mm);
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    }
}

}  // namespace
}  // namespace trueflank::test
