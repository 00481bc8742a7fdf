// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

// Names that an answer shows as it is in the end, though the forms beside them took them on the
// way; and names that a doubted one took with it.
namespace trueflank::test {
namespace {

/// How far along the profile a spot lies: 0 at the root, 1 at the tip.
double share_of(const FlankSpot& s) { return 0.5 * (s.u + 1.0); }

// The direction of the dirt is twice per turn in parts: an oval section that is doubted by these.
TEST(DoubtedNames, TakeNoOthersWithThem) {
  constexpr double kTowards = 5.52;
  const MadeGear gear = helical(59, -20.0);
  const auto dirt = [=](const MadeGear& g, const FlankSpot& s, const Vec3&) {
    const Vec3 n = normal_at(g, s);
    const double facing = n[0] * std::cos(kTowards) + n[1] * std::sin(kTowards);
    return (facing > 0.0 ? 5.0 * facing * facing : 0.0) - 3.5 * s.u + 7.0 * (1.0 - s.u * s.u);
  };
  const auto result = close(gear, scan_of(gear, {grown(dirt)}, scanned(9000, 1.1, 3)), true);
  expect_size(result, "pressure_angle_error", "slope_um", -7.0, 0.4);
  expect_size(result, "profile_crowning", "amount_um", 7.0, 0.4);
}

// Every other tooth leans the other way: that has no mean, and a relief is no part of it.
TEST(SettledNames, AReliefBesideTeethThatLeanInTurn) {
  const MadeGear gear = spur(32);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.tooth % 2 == 1 ? 12.0 : -12.0) * s.u -
           12.0 * std::pow(std::max(share_of(s) - 0.5, 0.0) / 0.5, 2);
  };
  InspectionOptions options;
  options.helix = options.index = false;
  options.noise_um = 1.5;
  options.seed = 2;
  const auto result = close(gear, inspection_of(gear, {grown(made)}, options));
  expect_size(result, "tip_relief", "amount_um", 12.0, 0.6);
}

/// A profile that leans and is relieved from a share of its length on.
Process leaning_and_relieved(double slope_um, double relief_um, double from) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    return 0.5 * slope_um * s.u -
           relief_um * std::pow(std::max(share_of(s) - from, 0.0) / (1.0 - from), 2);
  });
}
void expect_slope_and_relief(const loop::LoopResult& result, double slope_um, double relief_um,
                             double within) {
  expect_size(result, "pressure_angle_error", "slope_um", slope_um, within);
  expect_size(result, "tip_relief", "amount_um", relief_um, within);
}

// Both take material off the tip: what rises towards it says nearly as much, with a value less.
TEST(SettledNames, ASlopeAndAReliefInsteadOfOneRise) {
  const MadeGear gear = spur(34);
  for (const unsigned seed : survey_of(2, {2U, 3U, 4U, 5U, 6U})) {
    const auto traces = inspection_of(gear, {leaning_and_relieved(-1.65, 2.85, 0.62)},
                                      traced({1, 6, 12, 18, 23, 29}, 0.34, seed));
    expect_slope_and_relief(close(gear, traces), -1.65, 2.85, 0.45);
  }
}

// What swells from end to end imitates a slope towards the tip that a relief ends.
TEST(SettledNames, ASlopeAndAReliefInsteadOfASwelling) {
  const MadeGear gear = spur(40);
  for (const unsigned seed : survey_of(1, {14U, 15U, 17U})) {
    const auto traces = inspection_of(gear, {leaning_and_relieved(11.2, 11.6, 0.6)},
                                      traced({1, 10, 20, 30}, 1.36, seed));
    expect_slope_and_relief(close(gear, traces), 11.2, 11.6, 1.5);
  }
}

// A step of one tooth hides a taper and a crowning at first: they came to a bow from a place on,
// or to a part of a long wave.
TEST(SettledNames, ATaperAndACrowningInsteadOfABendOrALongWave) {
  const MadeGear gear = spur(20);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return 4.3 * s.v + 6.8 * (1.0 - s.v * s.v);
  };
  const auto slipped = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 6 && s.side > 0 && s.u > 0.1 ? 14.0 : 0.0;
  };
  const std::vector<int> four{1, 6, 11, 16}, three{1, 6, 14};
  for (const auto& [teeth, seed] : {std::pair{four, 3U}, std::pair{three, 1U}}) {
    const auto result =
        close(gear, inspection_of(gear, {grown(made), grown(slipped)}, traced(teeth, 0.9, seed)));
    expect_size(result, "taper", "slope_um", 8.6, 0.3);
    expect_size(result, "crowning", "amount_um", 6.8, 0.3);
  }
}

// A thickness that all flanks have stays beside waves of one of them.
TEST(SettledNames, AThicknessBesideFormsOfOneFlank) {
  const MadeGear gear = spur(26);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return -12.0 + (s.side > 0 ? 27.0 * std::cos(13.0 * s.u) : 34.0 * s.u);
  };
  const auto result = close(gear, scan_of(gear, {grown(made)}, scanned(9000, 4.0, 7)), true);
  expect_size(result, "contour_offset", "offset_um", -12.0, 0.5);
}

// A drift of one flank leaves a wave of the pitch to the other.  (Along the normal it is 0.94 of
// its size.)
TEST(SettledNames, AWaveOfThePitchBesideADriftOfOneFlank) {
  const MadeGear gear = spur(41);
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.6;
  options.seed = 4;
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const double gone = (s.tooth - 1.0) / g.teeth;
    return s.side * 4.0 * std::cos(2.0 * 2.0 * M_PI * gone - 1.5) +
           (s.side > 0 ? 30.0 * (1.0 - std::exp(-2.0 * gone)) : 0.0);
  };
  const auto result = close(gear, inspection_of(gear, {grown(made)}, options));
  expect_size(result, "pitch_wave", "amplitude_um", 4.26, 0.3);
}

// What leans above a height alone, or hollows that fade over the face, give no name to their
// pieces.
TEST(SettledNames, AreNoneOfProducts) {
  const MadeGear gear = spur(30);
  const auto leaning = [](auto&, const FlankSpot& s, auto&) {
    return s.v > 0.1 ? 15.0 * s.u : 0.0;
  };
  const auto fading = [](auto&, const FlankSpot& s, auto&) {
    return -14.0 * (1.0 + s.v) * std::exp(-std::pow((s.u + 0.1) / 0.32, 2));
  };
  for (const auto& um : {grown(leaning), grown(fading)}) {
    const auto result = close(gear, scan_of(gear, {um}, scanned(6000, 2.0, 6)), true);
    EXPECT_FALSE(has_name(result)) << list(result);
  }
}

// What is the same on every tooth is no part of what one tooth stands out by.
TEST(SettledNames, ASingleToothBesideAWornFlank) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    const double worn =
        s.side < 0 ? 20.0 * (std::exp(-std::pow((s.u + 0.1) / 0.25, 2)) - 1.0) : 0.0;
    return worn + (s.tooth == 3 ? 15.0 : 0.0);
  };
  const auto result =
      close(spur(24), scan_of(spur(24), {grown(made)}, scanned(2000, 1.5, 3)), true);
  expect_size(result, "single_tooth", "amount_um", 15.0, 1.0);
}

// The drift has a mean, which a scale has too; but the profiles say how much of it is one.
TEST(SettledNames, AScaleBesideADriftOfAllTeeth) {
  const MadeGear gear = helical(33, 19.6);
  const auto drifts = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return 27.0 * (1.0 - std::exp(-((s.tooth - 5 + g.teeth) % g.teeth) / (0.5 * g.teeth)));
  };
  ScanOptions options = scanned(4000, 2.4, 5);
  options.tips = false;
  const auto result = close(gear, scan_of(gear, {grown(drifts), scaled(-0.25)}, options), true);
  expect_size(result, "scale", "percent", -0.25, 0.02);
}

// A bent axis was all that was told: its opposite steps are one form, and then nothing was asked
// for the slope that these had taken up.
TEST(SettledNames, ASlopeOfAllFlanksBesideABentAxis) {
  MadeGear gear = spur(11);
  gear.face_mm = 13.9;
  const auto bent = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const Vec3 n = normal_at(g, s);
    return 14.0 * (1.0 - s.v * s.v) * (n[0] * std::cos(0.7) + n[1] * std::sin(0.7));
  };
  const auto turned = [](auto&, const FlankSpot& s, auto&) { return 3.7 * s.side * s.v; };
  const auto result = close(gear, inspection_of(gear, {grown(bent), grown(turned)},
                                                traced({1, 2, 4, 6, 8, 10}, 0.77, 1)));
  expect_size(result, "helix_error", "slope_um", 7.4, 0.6);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

// In a scan of flanks alone a size of the part is a thickness and a lean in one ratio.
TEST(SettledNames, ACoatThatIsThinAtTheRootIsNoSizeOfThePart) {
  for (const auto& [teeth, um, noise_um] :
       survey_of(1, {std::tuple{35, 14.5, 2.2}, {42, 24.0, 4.0}})) {
    const MadeGear gear = spur(teeth);
    const double levels_off = teeth == 35 ? 0.3 : 0.23;
    const auto coat = grown([levels_off, um = um](auto&, const FlankSpot& s, auto&) {
      return um * (1.0 - std::exp(-share_of(s) / levels_off));
    });
    const auto result = close(gear, scan_of(gear, {coat}, scanned(6000, noise_um, 4)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
    EXPECT_TRUE(tells(result, "more and more over the profile towards the root")) << list(result);
  }
}

// Together they lean as a part of another size and one more lean would: of names that say the same
// the usual one is told, and the other with it.
TEST(SettledNames, ALeadAndALeanOfAHelicalGearAreNoSizeOfThePart) {
  const MadeGear gear = helical(49, -26.0);
  const auto made = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side * 1.4 * s.v + 1.0 * s.u + 2.5 * (1.0 - s.u * s.u);
  });
  int named = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto result = close(gear, inspection_of(gear, {made}, traced({1, 17, 33}, 0.37, seed)));
    EXPECT_EQ(find(result, "scale"), nullptr) << seed << ": " << list(result);
    const auto* lead = find(result, "helix_error");
    if (lead == nullptr) continue;
    ++named;
    EXPECT_NE(lead->sentence.find("once scale"), std::string::npos) << lead->sentence;
  }
  EXPECT_EQ(named, 4);
}

}  // namespace
}  // namespace trueflank::test
