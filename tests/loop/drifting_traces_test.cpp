// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Traces on one zero of which each stands a little higher than the one before it: part or machine
// warmed up while it was measured.
namespace trueflank::test {
namespace {

struct Warming {
  int teeth = 0;
  std::vector<int> traced;
  double um = 0.0;
  double within = 0.0;  // of the way; 0: even
  bool right_first = false, profile = true;
};

double warmed(const Warming& drift, const MadeGear& gear, const FlankSpot& spot) {
  const auto at = std::find(drift.traced.begin(), drift.traced.end(), spot.tooth);
  const bool first = (flank_name(gear, spot.side) == Flank::kRight) == drift.right_first;
  const double share =
      (2.0 * static_cast<double>(at - drift.traced.begin()) + (first ? 0.0 : 1.0)) /
      (2.0 * static_cast<double>(drift.traced.size()) - 1.0);
  return drift.um * (drift.within == 0.0
                         ? share
                         : std::expm1(-share / drift.within) / std::expm1(-1.0 / drift.within));
}

Warming drawn(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Warming drift;
  drift.teeth = static_cast<int>(between(17.0, 48.0));
  const auto traced = static_cast<std::size_t>(between(6.0, 12.0));
  std::vector<int> teeth;
  for (int tooth = 1; tooth <= drift.teeth; ++tooth) teeth.push_back(tooth);
  std::shuffle(teeth.begin(), teeth.end(), random);
  teeth.resize(traced);
  std::sort(teeth.begin(), teeth.end());
  drift.traced = teeth;
  drift.um = std::copysign(between(4.0, 20.0), between(-1.0, 1.0));
  drift.right_first = between(-1.0, 1.0) < 0.0;
  drift.profile = between(-1.0, 1.0) < 0.0;
  return drift;
}

loop::LoopResult closed(const Warming& drift, double noise_um, unsigned seed) {
  const MadeGear gear = spur(drift.teeth);
  InspectionOptions options = traced(drift.traced, noise_um, seed);
  options.common_zero = true;
  options.points = 60;
  options.profile = drift.profile;
  options.helix = !drift.profile;
  return close(gear, inspection_of(gear, {grown([&](auto& g, const FlankSpot& s, auto&) {
                                     return warmed(drift, g, s);
                                   })},
                                   options));
}

TEST(DriftingTraces, AreToldAsADriftFromTraceToTrace) {
  std::mt19937_64 random(641);
  for (unsigned draw = 0; draw < 8; ++draw) {
    const Warming drift = drawn(random);
    const auto result = closed(drift, 0.08 * std::abs(drift.um), draw);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << draw << list(result);
    EXPECT_FALSE(has_name(result)) << draw << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << draw << list(result);
    EXPECT_TRUE(tells(result, "from trace to trace")) << draw << list(result);
    EXPECT_TRUE(tells(result, drift.um > 0.0 ? "towards more material" : "towards less material"))
        << draw << list(result);
    EXPECT_TRUE(tells(result, drift.right_first ? "the right flank first" : "the left flank first"))
        << draw << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().amplitude(), std::abs(drift.um),
                0.06 * std::abs(drift.um))
        << draw << list(result);
  }
}

TEST(DriftingTraces, LevelOffAsAMachineDoesThatIsWarm) {
  std::mt19937_64 random(642);
  for (unsigned draw = 0; draw < 3; ++draw) {
    Warming drift = drawn(random);
    drift.within = 0.3;
    const auto result = closed(drift, 0.05 * std::abs(drift.um), draw);
    EXPECT_FALSE(has_name(result)) << draw << list(result);
    EXPECT_TRUE(tells(result, "from trace to trace")) << draw << list(result);
    EXPECT_TRUE(tells(result, "levels off")) << draw << list(result);
  }
}

// What the gear has is told as before: an offset of all walls, or an eccentricity.
TEST(DriftingTraces, AreNoneWhereTheGearHasAName) {
  std::mt19937_64 random(643);
  for (unsigned draw = 0; draw < 6; ++draw) {
    const Warming drift = drawn(random);
    const MadeGear gear = spur(drift.teeth);
    InspectionOptions options = traced(drift.traced, 0.6, draw);
    options.common_zero = true;
    const double um = std::abs(drift.um), towards = draw;
    const auto result =
        close(gear, inspection_of(gear, {grown([&](auto& g, const FlankSpot& s, auto&) {
                                    return draw % 2 == 0
                                               ? um
                                               : um * s.side *
                                                     std::sin(2.0 * M_PI * (s.tooth - 1) / g.teeth -
                                                              towards);
                                  })},
                                  options));
    EXPECT_FALSE(tells(result, "from trace to trace")) << draw << list(result);
    EXPECT_TRUE(has_name(result)) << draw << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
