// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Gaps that are cut one by one: both flanks of each share what its cut left, and no tooth does.
namespace trueflank::test {
namespace {

/// The gap on a flank's side of its tooth: the number of the tooth before it, counter-clockwise.
int gap_of(const MadeGear& g, const FlankSpot& s) {
  return s.side > 0 ? s.tooth : (s.tooth + g.teeth - 2) % g.teeth + 1;
}

InspectionOptions index_of(double noise_um, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}

std::string listed(const std::set<int>& numbers) {
  std::string text;
  int left = static_cast<int>(numbers.size());
  for (const int number : numbers)
    text += (text.empty() ? "" : left == 1 ? " and " : ", ") + std::to_string(number), --left;
  return text;
}

class Drawn {
 public:
  explicit Drawn(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::set<int> some_of(int all, int count) {
    std::set<int> some;
    while (static_cast<int>(some.size()) < count)
      some.insert(1 + static_cast<int>(between(0.0, all - 1e-9)));
    return some;
  }

 private:
  std::mt19937_64 random_;
};

// Both were the measurement's own noise, 3.7 um of 0.8.
TEST(GapsOfTwoKinds, AreTold) {
  Drawn drawn(571);
  for (unsigned draw = 1; draw <= survey_size(4U, 12U); ++draw) {
    const int teeth = 24 + static_cast<int>(drawn.between(0.0, 40.0));
    const MadeGear gear = draw % 2 == 0 ? ring(teeth + 20) : spur(teeth);
    const double noise_um = 0.8, by_um = drawn.between(5.0, 10.0);
    const std::set<int> narrow =
        drawn.some_of(gear.teeth, static_cast<int>(drawn.between(0.2, 0.45) * gear.teeth));
    const bool aside = draw % 3 == 0;  // they are no narrower, but stand aside
    const auto gaps = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      return narrow.count(gap_of(g, s)) == 0 ? 0.0 : aside ? by_um * s.side : by_um;
    });
    const auto result = close(gear, inspection_of(gear, {gaps}, index_of(noise_um, draw)));
    SCOPED_TRACE(list(result));
    EXPECT_TRUE(result.effects.empty());
    EXPECT_TRUE(tells(result, "of every gap between two teeth"));
    EXPECT_TRUE(tells(result, "the gaps that follow on teeth " + listed(narrow) +
                                  (aside ? " stand" : " are narrower")));
    // (a flank of the last tooth of a gap that stands out moves the gap counter-clockwise)
    EXPECT_EQ(tells(result, " counter-clockwise of the others"), aside);
    EXPECT_NEAR(result.noise, noise_um, 0.25 * noise_um);
  }
}

TEST(TeethOfTwoKinds, AreTold) {
  Drawn drawn(572);
  for (unsigned draw = 1; draw <= survey_size(3U, 8U); ++draw) {
    const MadeGear gear = spur(24 + static_cast<int>(drawn.between(0.0, 30.0)));
    const double noise_um = 0.8, by_um = drawn.between(5.0, 10.0);
    const std::set<int> thin =
        drawn.some_of(gear.teeth, static_cast<int>(drawn.between(0.25, 0.45) * gear.teeth));
    const auto kinds = grown(
        [&](auto&, const FlankSpot& s, auto&) { return thin.count(s.tooth) == 0 ? 0.0 : -by_um; });
    const auto result = close(gear, inspection_of(gear, {kinds}, index_of(noise_um, draw)));
    SCOPED_TRACE(list(result));
    EXPECT_TRUE(tells(result, "two kinds: teeth " + listed(thin) + " are thinner than the others"));
    EXPECT_NEAR(result.noise, noise_um, 0.25 * noise_um);
  }
}

TEST(GapsOfTheirOwn, AreNoTwoKindsAndNoiseIsNone) {
  unsigned alarms = 0;
  const unsigned all = survey_size(4U, 12U);
  for (unsigned draw = 1; draw <= all; ++draw) {
    const MadeGear gear = spur(30);
    Drawn drawn(draw);
    std::vector<double> width;
    for (int gap = 0; gap < gear.teeth; ++gap) width.push_back(drawn.between(-7.0, 7.0));
    const auto own = grown([&](const MadeGear& g, const FlankSpot& s, auto&) {
      return width[static_cast<std::size_t>(gap_of(g, s) - 1)];
    });
    const auto result = close(gear, inspection_of(gear, {own}, index_of(0.8, draw)));
    EXPECT_TRUE(tells(result, "of every gap between two teeth, alike on both its flanks"))
        << list(result);
    EXPECT_FALSE(tells(result, "two kinds")) << list(result);
    const auto nothing = close(gear, inspection_of(gear, {}, index_of(0.8, draw)));
    alarms += nothing.verdict == loop::Verdict::kNoEffect ? 0 : 1;
  }
  EXPECT_LE(12 * alarms, 1 * all);
}

}  // namespace
}  // namespace trueflank::test
