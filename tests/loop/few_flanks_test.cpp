// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/made_gears.h"

// Few teeth, or flanks of one side alone, were measured.
namespace trueflank::test {
namespace {

template <class Keep>
loop::InspectionData keep_rows(loop::InspectionData data, const Keep& keep) {
  std::erase_if(data.rows, [&](const loop::InspectionRow& row) { return !keep(row); });
  return data;
}

TEST(OneSideOfTheTeeth, LeavesOpenWhetherTheyTurnOrTaper) {
  const MadeGear gear = spur(24);
  for (const double um : {9.0, -9.0}) {
    const auto turned =
        grown([um](const MadeGear&, const FlankSpot& s, auto&) { return 0.5 * um * s.v * s.side; });
    for (const Flank flank : {Flank::kLeft, Flank::kRight}) {
      InspectionOptions options = traced({1, 9, 17}, 0.6, 3);
      options.profile = false;
      const auto data =
          keep_rows(inspection_of(gear, {turned}, options),
                    [&](const loop::InspectionRow& row) { return row.flank == flank; });
      const auto result = close(gear, data);
      const auto* told = find(result, "helix_error");
      ASSERT_NE(told, nullptr) << list(result);
      EXPECT_NE(std::find(told->confounded_with.begin(), told->confounded_with.end(), "taper"),
                told->confounded_with.end())
          << list(result);
    }
  }
}

TEST(FewIndexValues, OfOneFlankShowAnEccentricity) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U, 5U})) {
    const MadeGear gear = spur(24 + 2 * static_cast<int>(seed));
    const auto off_axis = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
      const Vec3 n = normal_at(g, s);
      return 5.5 * (n[0] * std::cos(2.0) + n[1] * std::sin(2.0));
    });
    InspectionOptions options = traced({1}, 0.7, seed);
    options.profile = options.helix = false;
    options.index = true;
    const auto few = [&](const loop::InspectionRow& row) {
      return row.flank == Flank::kLeft && row.tooth % 3 == 1 && row.tooth < 23;
    };
    const auto result = close(gear, keep_rows(inspection_of(gear, {off_axis}, options), few));
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    expect_size(result, "eccentricity", "amplitude_um", 5.5, 1.5);
    EXPECT_LT(result.noise, 2.0) << list(result);
    const auto nothing = close(gear, keep_rows(inspection_of(gear, {}, options), few));
    EXPECT_EQ(nothing.verdict, loop::Verdict::kNoEffect) << list(nothing);
  }
}

// A rim that sank over some teeth, of which an index shows one value each.
TEST(SunkRim, IsNoSingleTooth) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U, 5U, 6U})) {
    const MadeGear gear = spur(40);
    const double towards = 0.4 + 0.7 * seed;
    const auto sunk = grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
      const Vec3 at = point_on(g, s), n = normal_at(g, s);
      const double angle = std::atan2(at[1], at[0]),
                   off = std::remainder(angle - towards, 2.0 * M_PI) / 0.28;
      return -8.0 * std::exp(-0.5 * off * off) * (n[0] * std::cos(angle) + n[1] * std::sin(angle));
    });
    InspectionOptions options = traced({1, 8, 14, 21, 28, 34}, 0.7, seed);
    options.index = options.common_zero = true;
    const auto result = close(gear, inspection_of(gear, {sunk}, options));
    EXPECT_EQ(find(result, "single_tooth"), nullptr) << list(result);
    EXPECT_TRUE(tells(result, "a hollow of the body towards")) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
