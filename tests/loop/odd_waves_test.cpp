// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// Waves of traces that change their length along the flank, or ring where a trace begins.
namespace trueflank::test {
namespace {

struct TracedGear {
  MadeGear gear;
  std::vector<int> teeth;
};

class OddWaves : public testing::Test {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  TracedGear drawn() {
    TracedGear made{spur(static_cast<int>(between(16.0, 48.0))), {}};
    const int count = static_cast<int>(between(3.0, 8.0));
    for (int k = 0; k < count; ++k) made.teeth.push_back(1 + k * made.gear.teeth / count);
    return made;
  }
  static loop::LoopResult closed(const TracedGear& made, double noise_um, bool profile, bool helix,
                                 unsigned seed, const std::function<double(const FlankSpot&)>& um) {
    InspectionOptions options = traced(made.teeth, noise_um, seed);
    options.points = 160;
    options.profile = profile;
    options.helix = helix;
    return close(
        made.gear,
        inspection_of(made.gear, {grown([&](auto&, const FlankSpot& s, auto&) { return um(s); })},
                      options));
  }
  std::mt19937_64 random_{646};
};

/// Of the way from root or lower end on.
double share(double coordinate) { return 0.5 * (coordinate + 1.0); }

TEST_F(OddWaves, ThatChangeTheirLengthAreOneForm) {
  for (unsigned draw = 0; draw < 8; ++draw) {
    const TracedGear made = drawn();
    const bool face = draw % 2 == 0;
    double first = between(2.0, 5.0), more = between(4.0, 7.0);  // phase first s + more s^2
    if (draw % 3 == 1) {
      first += 2.0 * more;
      more = -more;
    }
    const double phase = between(0.0, 6.28), um = between(5.0, 15.0);
    const auto result = closed(made, 0.12 * um, !face, face, draw, [&](const FlankSpot& spot) {
      const double s = share(face ? spot.v : spot.u);
      return um * std::cos(2.0 * M_PI * (first * s + more * s * s) - phase);
    });
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << draw << list(result);
    EXPECT_TRUE(tells(result, "that change their length")) << draw << list(result);
    EXPECT_FALSE(has_name(result)) << draw << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << draw << list(result);
    ASSERT_EQ(result.effects.front().terms.size(), 1U) << draw << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().amplitude(), um, 0.06 * um)
        << draw << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().shape[2], more / (first + more), 0.05)
        << draw << list(result);
  }
}

// The probe meets the flank: profile and helix begin with the same swing.
TEST_F(OddWaves, ThatDieAwayFromWhereBothTracesBeginAreOneFormEach) {
  for (unsigned draw = 0; draw < 6; ++draw) {
    const TracedGear made = drawn();
    const double within = between(0.06, 0.14), waves = between(9.0, 20.0), um = between(8.0, 18.0);
    const auto swing = [&](double s) {
      return um * std::exp(-s / within) * std::cos(2.0 * M_PI * waves * s);
    };
    // (over the one, and over the other: neither has the other's course, as all traces stand
    // in the middle of the other way)
    const auto result = closed(made, 0.1 * um, true, true, draw, [&](const FlankSpot& spot) {
      const double u = share(spot.u), v = share(spot.v);
      return swing(u) + swing(v);
    });
    int dying = 0;
    for (const auto& effect : result.effects)
      for (const auto& term : effect.terms)
        for (const auto& [key, value] : term.keys) dying += key == "dies_within_mm" ? 1 : 0;
    EXPECT_EQ(dying, 2) << draw << list(result);
    EXPECT_FALSE(has_name(result)) << draw << list(result);
    EXPECT_FALSE(tells(result, "a jump over")) << draw << list(result);
    EXPECT_FALSE(tells(result, "a ridge over")) << draw << list(result);
    EXPECT_FALSE(tells(result, "a groove over")) << draw << list(result);
  }
}

// What is no wave keeps its name or form.
TEST_F(OddWaves, AreNoneOfReliefsFeetAndWavesOfOneLength) {
  for (unsigned draw = 0; draw < 6; ++draw) {
    const TracedGear made = drawn();
    const double um = between(6.0, 15.0), waves = between(3.0, 12.0), at = between(0.1, 0.3);
    const auto result = closed(made, 0.06 * um, true, true, draw, [&](const FlankSpot& spot) {
      const double u = share(spot.u), v = share(spot.v);
      if (draw % 3 == 0) return -um * std::pow(std::max(0.0, u - 1.0 + at) / at, 2.0);
      if (draw % 3 == 1) return um * std::exp(-v / (0.3 * at));
      return um * std::cos(2.0 * M_PI * waves * v);
    });
    EXPECT_FALSE(tells(result, "change their length")) << draw << list(result);
    EXPECT_FALSE(tells(result, "die away")) << draw << list(result);
    EXPECT_NE(result.verdict, loop::Verdict::kNoEffect) << draw << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
