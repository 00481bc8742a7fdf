// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"

// One flank that is off by itself in a scan: how the part is turned about its axis is fitted, so
// half of its height on both flanks looks the same.
namespace trueflank::test {
namespace {

using testing::HasSubstr;

/// The right flanks are worn but for a ridge at mid profile.
Process worn_beside_a_ridge(double um) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? um * (std::exp(-std::pow((s.u + 0.1) / 0.25, 2)) - 1.0) : 0.0;
  });
}
Process thinned(double um) {
  return grown([=](auto&, const FlankSpot&, auto&) { return -um; });
}

TEST(OneFlank, WornBesideARidgeIsNoThinTooth) {
  const auto result =
      close(spur(24), scan_of(spur(24), {worn_beside_a_ridge(20)}, scanned(2000, 1.5, 3)), true);
  EXPECT_FALSE(has_name(result)) << list(result);
  for (const auto& effect : result.effects) EXPECT_EQ(effect.flank, "right") << list(result);
  ASSERT_EQ(result.effects.size(), 2U) << list(result);
  const auto& level = result.effects.back();
  EXPECT_NEAR(std::abs(parameter(level, "amplitude_um").value), 20.0, 1.0) << list(result);
  EXPECT_THAT(level.sentence, HasSubstr("or both flanks do by "));
}

TEST(OneFlank, ThinTeethBesideASmallRidgeOfOneFlankStayThinTeethAndTheTurnIsSaidToBeOpen) {
  const auto ridge = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? 6.0 * std::exp(-std::pow((s.u - 0.1) / 0.15, 2)) : 0.0;
  });
  const auto result =
      close(spur(24), scan_of(spur(24), {thinned(20), ridge}, scanned(2000, 1.5, 4)), true);
  const auto* thin = find(result, "contour_offset");
  ASSERT_NE(thin, nullptr) << list(result);
  EXPECT_THAT(thin->sentence, HasSubstr("or flanks of one side alone do by 4"));
  EXPECT_THAT(thin->sentence,
              HasSubstr("a scan does not show how the part is turned about its axis"));
  EXPECT_THAT(thin->sure, HasSubstr("on which flanks is open"));
}

TEST(OneFlank, EveryThirdFlankOfOneSideIsNoWaveAndNoThinTooth) {
  const auto third = grown([](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 && s.tooth % 3 == 2 ? -10.0 : 0.0;
  });
  const auto result = close(
      spur(48),
      scan_of(spur(48), {third, off_centre(17, 20), leaning(3.2, -16)}, scanned(4000, 3.3, 5)),
      true);
  EXPECT_EQ(find(result, "tooth_thickness"), nullptr) << list(result);
  EXPECT_TRUE(tells(result, "one tooth in 3, from tooth 2 on, lies back")) << list(result);
}

TEST(OneFlank, WavesOfOneSideAreOneFormAndNotHalfOfItEqualAndHalfOpposite) {
  const auto waves = grown([](auto& g, const FlankSpot& s, auto&) {
    return s.side < 0 ? 9.0 * s.v * std::cos(2.0 * M_PI * 3.0 * s.tooth / g.teeth) : 0.0;
  });
  const auto result = close(spur(30), scan_of(spur(30), {waves}, scanned(2000, 2.0, 6)), true);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_EQ(result.effects[0].flank, "right") << list(result);
  EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 9.0, 0.5) << list(result);
}

}  // namespace
}  // namespace trueflank::test
