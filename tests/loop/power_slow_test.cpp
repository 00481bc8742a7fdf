// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/counted_runs.h"
#include "tests/support/survey_size.h"

// How small an effect is found in nine runs of ten. The table stands in docs/loop.md.
namespace trueflank::test {
namespace {

using Maker = std::function<Process(double um)>;

struct PowerCase {
  std::string id;
  Maker make;
};

std::vector<PowerCase> power_cases() {
  return {{"eccentricity", [](double um) { return off_centre(um, 30); }},
          {"lobing", [](double um) { return out_of_round(3, um, 40); }},
          {"crowning",
           [](double um) {
             return grown([um](auto&, const FlankSpot& s, auto&) { return -um * s.v * s.v; });
           }},
          {"helix_error", [](double um) { return twisted(um); }}};
}

/// Smallest amplitude [um] found by its name in nine of ten runs (the gate: in four of four), on a
/// ladder of steps by sqrt(2). What is larger than the noise of a single point is not what is asked
/// here, and must be found in both of two runs.
double smallest_found_um(const PowerCase& c, int points, double noise_um) {
  const MadeGear gear = small_gear();
  double smallest = INFINITY;
  for (double um = 4.0 * noise_um; um > 0.05 * noise_um; um /= std::sqrt(2.0)) {
    const bool large = um > 1.01 * noise_um;
    const int runs = large ? 2 : survey_size(4, 10), misses = large ? 0 : survey_size(0, 1);
    int found = 0;
    for (int run = 0; run < runs && run - found <= misses; ++run) {
      ScanOptions options;
      options.points = points;
      options.noise_um = noise_um;
      options.seed = 1000 + run;
      found += find(close(gear, scan_of(gear, {c.make(um)}, options), true), c.id) != nullptr;
    }
    if (found < runs - misses) break;
    smallest = um;
  }
  return smallest;
}

void expect_growth_with_points(const PowerCase& c) {
  const double few = smallest_found_um(c, 1500, 5.0), many = smallest_found_um(c, 6000, 5.0);
  std::printf("%s: %.2f um of 1500 points, %.2f um of 6000, noise 5 um\n", c.id.c_str(), few, many);
  EXPECT_LE(few, 5.0) << c.id;  // one sigma at worst
  EXPECT_LE(many, few / 1.3) << c.id;  // four times the points: half, within a step of the ladder
}

TEST(Power, OfBodyEffectsGrowsWithTheNumberOfPoints) {
  for (const std::size_t i : {0, 1}) expect_growth_with_points(power_cases()[i]);
}
TEST(Power, OfFlankEffectsGrowsWithTheNumberOfPoints) {
  for (const std::size_t i : {2, 3}) expect_growth_with_points(power_cases()[i]);
}

TEST(Power, GoesWithTheNoise) {
  const PowerCase lobing = power_cases()[1];
  const double loud = smallest_found_um(lobing, 1500, 10.0), quiet = smallest_found_um(lobing, 1500, 2.5);
  std::printf("lobing: %.2f um at noise 10 um, %.2f um at 2.5 um\n", loud, quiet);
  EXPECT_NEAR(loud / quiet, 4.0, 1.7);
}

}  // namespace
}  // namespace trueflank::test
