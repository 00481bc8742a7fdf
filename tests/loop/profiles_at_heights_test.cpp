// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/loop/one_drawn_form.h"
#include "tests/loop/topography.h"
#include "trueflank/loop/gear/observations.h"

// Profiles of a flank at several heights are traces of their own: how they differ is no noise,
// whether they share a zero or have one each.
namespace trueflank::test {
namespace {

constexpr double kNoise_um = 1.5;

struct Topography {
  Zeros zeros = Zeros::kCommon;
  std::vector<double> heights;
  int every = 5;
};

const std::vector<Topography>& topographies() {
  static const std::vector<Topography> all{{Zeros::kCommon, {0.1, 0.5, 0.9}, 5},
                                           {Zeros::kCommon, {0.1, 0.3, 0.5, 0.7, 0.9}, 1},
                                           {Zeros::kOfFlanks, {0.1, 0.5, 0.9}, 3},
                                           {Zeros::kOfTraces, {0.1, 0.4, 0.6, 0.9}, 3}};
  return all;
}

std::string words(const Topography& of, const loop::LoopResult& result) {
  return std::to_string(of.heights.size()) + " heights, every " + std::to_string(of.every) + ": " +
         list(result);
}

template <class Um>
loop::LoopResult closed(const MadeGear& gear, const Topography& of, unsigned seed, const Um& um) {
  const auto made = grown([um](auto&, const FlankSpot& s, auto&) { return um(s); });
  return close(gear, topography(gear, made, of.zeros, of.heights, of.every, kNoise_um, 6.0, seed));
}

void expect_all_explained(const Topography& of, const loop::LoopResult& result) {
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << words(of, result);
  EXPECT_EQ(result.effects.size(), 1U) << words(of, result);
  EXPECT_NEAR(result.noise, kNoise_um, 0.15 * kNoise_um) << words(of, result);
}

TEST(ProfilesAtHeights, ShowATwistByItsName) {
  unsigned seed = 40;
  for (const Topography& of : topographies()) {
    const auto result =
        closed(spur(30), of, ++seed, [](const FlankSpot& s) { return 12.0 * s.u * s.v; });
    expect_all_explained(of, result);
    expect_size(result, "flank_twist", "amount_um", 12.0, 1.0);
  }
}

TEST(ProfilesAtHeights, ShowATwistThatIsOppositeOnTheFlanks) {
  unsigned seed = 50;
  for (const Topography& of : topographies()) {
    const auto result =
        closed(spur(30), of, ++seed, [](const FlankSpot& s) { return 12.0 * s.side * s.u * s.v; });
    expect_all_explained(of, result);
    ASSERT_FALSE(result.effects.empty()) << words(of, result);
    EXPECT_FALSE(has_name(result)) << words(of, result);
    EXPECT_NEAR(amplitude_of_first(result), 12.0, 1.2) << words(of, result);
  }
}

TEST(ProfilesAtHeights, ShowATaperWhereTheyShareAZero) {
  unsigned seed = 60;
  for (const Topography& of : topographies()) {
    if (of.zeros == Zeros::kOfTraces) continue;
    const auto result = closed(spur(30), of, ++seed, [](const FlankSpot& s) { return 14.0 * s.v; });
    expect_all_explained(of, result);
    expect_size(result, "taper", "slope_um", 28.0, 1.5);
  }
}

TEST(ProfilesAtHeights, OfNoiseShowNothing) {
  unsigned seed = 70;
  for (const Topography& of : topographies())
    for (int again = 0; again < 3; ++again) {
      const auto result = closed(spur(23 + 4 * again), of, ++seed, [](auto&) { return 0.0; });
      EXPECT_EQ(result.verdict, loop::Verdict::kNoEffect) << words(of, result);
      EXPECT_NEAR(result.noise, kNoise_um, 0.15 * kNoise_um) << words(of, result);
    }
}

TEST(ProfilesAtHeights, HaveTheNumberOfTheirLine) {
  const MadeGear gear = spur(23);
  const auto made = grown([](auto&, const FlankSpot&, auto&) { return 0.0; });
  loop::MeasuredData data;
  data.inspections.push_back(
      topography(gear, made, Zeros::kCommon, {0.9, 0.1, 0.5}, 4, kNoise_um, 0.0, 3));
  const auto geometry = geometry_of(gear);
  const auto table = loop::make_observations(geometry, data, {});
  ASSERT_TRUE(table);
  for (const loop::Observation& row : table->rows) {
    const double share = table->place(row).z_mm / geometry.face_width_mm();
    EXPECT_EQ(row.line, share < 0.3 ? 0 : share < 0.7 ? 1 : 2) << share;
  }
}

}  // namespace
}  // namespace trueflank::test
