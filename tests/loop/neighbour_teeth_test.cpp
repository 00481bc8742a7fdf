// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

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
  for (const int teeth : {17, 24}) {
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

}  // namespace
}  // namespace trueflank::test
