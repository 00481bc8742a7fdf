// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Every tooth stands aside by an amount of its own, in the index of a gear of few teeth.
namespace trueflank::test {
namespace {

class RandomPitch : public testing::Test {
 protected:
  double normal() { return std::normal_distribution<double>(0.0, 1.0)(random_); }
  loop::LoopResult closed(int teeth, double sd_um, double eccentricity_um, unsigned seed) {
    const MadeGear gear = spur(teeth);
    std::vector<double> aside;
    for (int tooth = 0; tooth < teeth; ++tooth) aside.push_back(sd_um * normal());
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.1 * sd_um;
    options.seed = seed;
    return close(gear,
                 inspection_of(gear, {grown([&](auto&, const FlankSpot& s, auto&) {
                                 return s.side *
                                        (aside[static_cast<std::size_t>(s.tooth - 1)] +
                                         eccentricity_um * std::cos(2.0 * M_PI * s.tooth / teeth));
                               })},
                               options));
  }
  std::mt19937_64 random_{647};
};

TEST_F(RandomPitch, OfFewTeethIsNoWaveWithAName) {
  int named = 0;
  std::string told;
  for (unsigned draw = 0; draw < 120; ++draw) {
    const auto result = closed(11 + static_cast<int>(draw % 7), 4.0, 0.0, draw);
    if (!has_name(result)) continue;
    ++named;
    told += std::to_string(draw) + ": " + list(result) + "\n";
  }
  EXPECT_EQ(named, 0) << told;
}

TEST_F(RandomPitch, HidesNoWaveThatIsFarLarger) {
  int named = 0;
  std::string told;
  for (unsigned draw = 0; draw < 10; ++draw) {
    const auto result = closed(12 + static_cast<int>(draw), 1.5, 9.0, draw);
    named += has_name(result) ? 1 : 0;
    told += std::to_string(draw) + ": " + list(result) + "\n";
  }
  EXPECT_EQ(named, 10) << told;
}

}  // namespace
}  // namespace trueflank::test
