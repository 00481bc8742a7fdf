// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/made_gears.h"

// What stands out towards one end of the face, or towards both.
namespace trueflank::test {
namespace {

double height_mm(const MadeGear& g, const FlankSpot& s) { return 0.5 * (s.v + 1.0) * g.face_mm; }

TEST(EndOfTheFace, IsToldAsItDiesAwayOrKinks) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U})) {
    const MadeGear gear = spur(22 + static_cast<int>(seed));
    const double part = 0.05 + 0.01 * seed;
    for (const bool kinked : {false, true}) {
      const auto process = grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
        if (s.side > 0) return 0.0;
        const double below = 0.975 * g.face_mm - height_mm(g, s);  // the last value
        return kinked ? 6.0 * std::max(0.0, 1.0 - below / (0.2 * g.face_mm))
                      : 6.0 * std::exp(-below / (part * g.face_mm));
      });
      const auto result =
          close(gear, inspection_of(gear, {process}, traced({1, 5, 9, 13, 17, 21}, 0.6, seed)));
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
      EXPECT_TRUE(tells(result, kinked ? "a kink over the face" : "towards the upper end, within"))
          << list(result);
      EXPECT_TRUE(tells(result, "um at the last height measured")) << list(result);
    }
  }
}

TEST(EndOfTheFace, OfOneToothDiesAway) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U})) {
    const MadeGear gear = spur(24);
    const int tooth = 4 + static_cast<int>(seed);
    const auto process = grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
      return s.tooth == tooth && s.side > 0 ? 40.0 * std::exp(-height_mm(g, s) / (0.22 * g.face_mm))
                                            : 0.0;
    });
    const auto result = close(gear, scan_of(gear, {process}, scanned(24000, 4.0, seed)), true);
    EXPECT_TRUE(tells(result, "alone, more and more over the face towards the lower end, within"))
        << list(result);
  }
}

// A layer that is thicker at both ends: an elephant's foot stands at one.
TEST(BothEnds, AreOneFormBesideAnOffset) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U})) {
    const MadeGear gear = spur(28);
    const double part = 0.1 + 0.01 * seed;
    const auto process = grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
      const double z = height_mm(g, s), decay = part * g.face_mm;
      return 5.0 + 27.0 * (std::exp(-z / decay) + std::exp(-(g.face_mm - z) / decay));
    });
    const auto result = close(gear, scan_of(gear, {process}, scanned(26000, 4.0, seed)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    EXPECT_EQ(find(result, "elephant_foot"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "over the face towards both ends")) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
