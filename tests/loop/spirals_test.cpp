// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/made_gears.h"

// What drifts evenly once around a gear and jumps back.
namespace trueflank::test {
namespace {

double turns_of(const MadeGear& g, const FlankSpot& s, double from_deg) {
  const Vec3 at = point_on(g, s);
  double turns = std::atan2(at[1], at[0]) / (2.0 * M_PI) - from_deg / 360.0;
  while (turns < 0.0) turns += 1.0;
  return turns;
}

/// All walls, by the direction in which they lie.
Process drifting(double from_deg, double um) {
  return grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
    return um * (turns_of(g, s, from_deg) - 0.5);
  });
}

const loop::Term* spiral_of(const loop::LoopResult& result) {
  for (const auto& effect : result.effects)
    for (const auto& term : effect.terms)
      if (term.text.find("all walls drift evenly") != std::string::npos) return &term;
  return nullptr;
}

double degrees_of(const loop::Term& term, const std::string& name) {
  for (const auto& [key, value] : term.keys)
    if (key == name) return std::get<double>(value);
  return NAN;
}

TEST(DriftOfAllWalls, IsOneFormBesideANameToo) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U})) {
    const MadeGear gear = spur(23 + static_cast<int>(seed));
    // (within a tooth: between two teeth a drift from tooth to tooth says the same)
    const double from = (3 + seed) * 360.0 / gear.teeth + 1.2, um = seed % 2 == 0 ? -16.0 : 16.0;
    for (const bool crowned : {false, true}) {
      std::vector<Process> processes{drifting(from, um)};
      if (crowned)
        processes.push_back(
            grown([](const MadeGear&, const FlankSpot& s, auto&) { return -7.0 * s.v * s.v; }));
      const auto result = close(gear, scan_of(gear, processes, scanned(20000, 4.0, seed)), true);
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
      EXPECT_EQ(result.effects.size(), crowned ? 2U : 1U) << list(result);
      const loop::Term* told = spiral_of(result);
      ASSERT_NE(told, nullptr) << list(result);
      EXPECT_NEAR(told->cos, um, 0.5) << list(result);
      EXPECT_NEAR(std::remainder(degrees_of(*told, "from_deg") - from, 360.0), 0.0, 1.0)
          << list(result);
    }
  }
}

TEST(DriftOfAllWalls, IsNoneOfTeethSectorsOrWaves) {
  const MadeGear gear = spur(26);
  for (const int kind : {0, 1, 2, 3}) {
    const auto process = grown([kind](const MadeGear& g, const FlankSpot& s, auto&) {
      const double turns = turns_of(g, s, 0.0);
      if (kind == 0) return s.tooth == 5 ? 16.0 : 0.0;
      if (kind == 1) return s.tooth > 4 && s.tooth < 15 ? 12.0 : 0.0;
      if (kind == 2) return 8.0 * std::sin(2.0 * M_PI * turns) + 4.0 * std::sin(4.0 * M_PI * turns);
      return 16.0 * (s.tooth - 1.0) / 26.0;  // from tooth to tooth
    });
    const auto result = close(gear, scan_of(gear, {process}, scanned(20000, 4.0, 5)), true);
    EXPECT_EQ(spiral_of(result), nullptr) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
