// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/loop/made_gears.h"

// What stands over a few neighbouring teeth and is no wave.
namespace trueflank::test {
namespace {

/// A dent of so many teeth about tooth 5, above mid face, on both flanks.
Process dented(double um, double over_teeth) {
  return grown([=](const MadeGear& gear, const FlankSpot& s, const Vec3&) {
    double off = std::abs(s.tooth - 5.0);
    off = std::min(off, gear.teeth - off) / over_teeth;
    return -um * std::exp(-off * off - std::pow((s.v - 0.3) / 0.4, 2));
  });
}

TEST(NeighbourTeeth, ADentOverThreeTeethIsToldThoughNoWaveExplainsIt) {
  for (const int teeth : survey_of(1, {17, 24})) {
    const MadeGear gear = spur(teeth);
    const auto result =
        close(gear, scan_of(gear, {dented(40.0, 1.5)}, {.points = 8000, .noise_um = 4.0}), true);
    ASSERT_FALSE(result.effects.empty()) << list(result);
    const auto& dent = result.effects.front();
    EXPECT_FALSE(dent.named) << list(result);
    EXPECT_NE(dent.description.find("about tooth 5"), std::string::npos) << dent.description;
    ASSERT_FALSE(dent.terms.empty());
    EXPECT_NEAR(dent.terms.front().cos, -40.0, 5.0);
    EXPECT_LT(result.after.held_out_rms, 1.1 * 4.0);
    EXPECT_EQ(find(result, "single_tooth"), nullptr) << list(result);
  }
}

TEST(NeighbourTeeth, OneToothAloneIsNoMatterOfNeighbours) {
  const MadeGear gear = spur(24);
  const auto one = grown([](auto&, const FlankSpot& s, auto&) { return s.tooth == 5 ? 45.0 : 0.0; });
  const auto result = close(gear, scan_of(gear, {one}, {.points = 8000, .noise_um = 4.0}), true);
  EXPECT_NE(find(result, "single_tooth"), nullptr) << list(result);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << result.structure_left;
}

/// Teeth 12 to 14 as a knock leaves them: out on both flanks, or aside.
Process knocked(double um, bool aside) {
  return grown([=](const MadeGear&, const FlankSpot& s, const Vec3&) {
    const double share = s.tooth == 12 ? 0.45 : s.tooth == 13 ? 1.0 : s.tooth == 14 ? 0.6 : 0.0;
    return um * share * (aside ? s.side : 1);
  });
}

// A swelling has as many values as three teeth, and says less of them.
TEST(NeighbourTeeth, ThreeThatAKnockLeftUnequalAreEachTold) {
  for (const bool aside : {true, false})
    for (const double um : {12.0, -22.0}) {
      if (!is_surveyed(aside == (um > 0.0))) continue;
      const MadeGear gear = spur(31);
      const auto result =
          close(gear, scan_of(gear, {knocked(um, aside)}, scanned(8000, 1.1, 5)), true);
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << result.structure_left;
      ASSERT_EQ(result.effects.size(), 3U) << list(result);
      for (const auto& effect : result.effects) {
        const auto is_of = [&](const char* tooth) {
          return effect.description.find(tooth) != std::string::npos;
        };
        const double share = is_of("tooth 12") ? 0.45 : is_of("tooth 13") ? 1.0 : 0.6;
        EXPECT_NEAR(std::abs(effect.terms.at(0).cos), share * std::abs(um), 0.6) << list(result);
        EXPECT_EQ(effect.description.find("aside") != std::string::npos, aside)
            << effect.description;
      }
    }
}

}  // namespace
}  // namespace trueflank::test
