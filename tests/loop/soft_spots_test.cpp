// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/loop/made_gears.h"

// Places of one flank with steep and with soft edges: how high they are told.
namespace trueflank::test {
namespace {

/// Of the answer's largest spot.
const loop::Term* spot_of(const loop::LoopResult& result) {
  for (const auto& effect : result.effects)
    for (const auto& term : effect.terms)
      for (const auto& [key, value] : term.keys)
        if (key == "edges") return &term;
  return nullptr;
}

std::string edges_of(const loop::Term& term) {
  for (const auto& [key, value] : term.keys)
    if (key == "edges") return std::get<std::string>(value);
  return "";
}

TEST(SoftSpots, ANickOnOneTraceHasItsHeight) {
  const MadeGear gear = spur(23);
  for (const bool soft : {true, false})
    for (const unsigned seed : survey_of(1, {1U, 2U, 3U})) {
      const auto made = grown([soft](const MadeGear& g, const FlankSpot& s, auto&) {
        const double off = std::pow((0.5 * g.face_mm * s.v - 1.1) / 0.7, soft ? 2 : 4);
        return s.tooth == 5 && s.side > 0 ? 11.0 * std::exp(-off) : 0.0;
      });
      InspectionOptions options;
      options.noise_um = 0.6;
      options.points = 60;
      options.seed = seed;
      const auto result = close(gear, inspection_of(gear, {made}, options));
      const loop::Term* spot = spot_of(result);
      ASSERT_NE(spot, nullptr) << list(result);
      EXPECT_NEAR(spot->amplitude(), 11.0, 1.1) << list(result);
      EXPECT_LE(std::abs(spot->amplitude() - 11.0), 1.5 * spot->half_width) << list(result);
      EXPECT_EQ(edges_of(*spot), soft ? "soft" : "steep") << list(result);
    }
}

// Small pits on five teeth, as of a flank that wears out.
TEST(SoftSpots, PitsOfAScanHaveTheirDepth) {
  const MadeGear gear = spur(25);
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U})) {
    const auto made = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
      if (s.side > 0 || s.tooth % 5 != 2) return 0.0;
      const double face_mm = 0.5 * g.face_mm * (s.v - 0.13 * (s.tooth / 5 - 2));
      return -55.0 * std::exp(-std::pow(face_mm / 0.9, 2) - std::pow((s.u + 0.2) / 0.3, 2));
    });
    const auto result = close(gear, scan_of(gear, {made}, scanned(14000, 4.0, seed)), true);
    double sum = 0.0, count = 0.0;
    for (const auto& effect : result.effects)
      for (const auto& term : effect.terms) {
        sum += term.amplitude();
        count += 1.0;
      }
    ASSERT_EQ(count, 5.0) << list(result);
    EXPECT_NEAR(sum / count, 55.0, 3.5) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
