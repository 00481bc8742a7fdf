// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/made_gears.h"

// Bands that come again over the face, and flights of steps, as of layers.
namespace trueflank::test {
namespace {

/// The term that has a value of this name; nullptr where none does.
const loop::Term* term_with(const loop::LoopResult& result, const std::string& name) {
  for (const auto& effect : result.effects)
    for (const auto& term : effect.terms)
      for (const auto& [key, value] : term.keys)
        if (key == name) return &term;
  return nullptr;
}

double number_of(const loop::Term& term, const std::string& name) {
  for (const auto& [key, value] : term.keys)
    if (key == name) return std::get<double>(value);
  return NAN;
}

/// Heights from `first_mm` on by turns high and low, each as wide as it says.
Process banded(double first_mm, double high_mm, double low_mm, double um) {
  return grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
    double at = 0.5 * (s.v + 1.0) * g.face_mm - first_mm;
    while (at < 0.0) at += high_mm + low_mm;
    while (at >= high_mm + low_mm) at -= high_mm + low_mm;
    return at < high_mm ? um : 0.0;
  });
}

Process stepped(double first_mm, double every_mm, double um) {
  return grown([=](const MadeGear& g, const FlankSpot& s, auto&) {
    double height = 0.0;
    for (double edge = first_mm; edge < 0.5 * (s.v + 1.0) * g.face_mm; edge += every_mm)
      height += um;
    return height;
  });
}

TEST(BandsOverTheFace, AreOneFormWithTheirEdges) {
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U})) {
    const MadeGear gear = seed % 2 == 0 ? helical(27, 15.0) : spur(22);
    const double high = 0.7 + 0.1 * seed, low = 0.9, um = seed % 2 == 0 ? -7.0 : 7.0;
    for (const bool traces : {false, true}) {
      const Process process = banded(0.4, high, low, um);
      InspectionOptions options = traced({1, 6, 11, 16, 21}, 0.8, seed);
      const auto result =
          traces ? close(gear, inspection_of(gear, {process}, options))
                 : close(gear, scan_of(gear, {process}, scanned(20000, 1.4, seed)), true);
      const loop::Term* told = term_with(result, "band_mm");
      ASSERT_NE(told, nullptr) << list(result);
      EXPECT_NEAR(told->amplitude(), 7.0, 0.4) << list(result);
      EXPECT_NEAR(number_of(*told, "period_mm"), high + low, 0.03) << list(result);
      const double band = um > 0.0 || told->cos < 0.0 ? high : low;
      EXPECT_NEAR(number_of(*told, "band_mm"), band, 0.12) << list(result);
      if (!traces) {
        EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
      }
    }
  }
}

TEST(BandsOverTheFace, AFlightOfStepsIsNoSawtoothBesideATaper) {
  const MadeGear gear = spur(22);
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U, 4U})) {
    const double every = 1.3 + 0.2 * seed;
    const auto result =
        close(gear, scan_of(gear, {stepped(0.6, every, 5.0)}, scanned(20000, 1.2, seed)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    EXPECT_TRUE(tells(result, "a flight of steps over the face")) << list(result);
    EXPECT_FALSE(has_name(result)) << list(result);
    const loop::Term* told = term_with(result, "period_mm");
    ASSERT_NE(told, nullptr) << list(result);
    EXPECT_NEAR(number_of(*told, "period_mm"), every, 0.02) << list(result);
    EXPECT_NEAR(told->amplitude(), 5.0, 0.1) << list(result);
  }
}

// Waves with a multiple, and teeth of a saw.
TEST(BandsOverTheFace, AreNotToldOfSmootherForms) {
  const MadeGear gear = spur(22);
  for (const bool saw : {false, true}) {
    const auto process = grown([saw](const MadeGear& g, const FlankSpot& s, auto&) {
      const double turns = 0.5 * (s.v + 1.0) * g.face_mm / 1.9;
      if (saw) return 8.0 * (turns - std::floor(turns));
      return 5.0 * std::sin(2.0 * M_PI * turns) + 1.5 * std::sin(6.0 * M_PI * turns);
    });
    const auto result = close(gear, scan_of(gear, {process}, scanned(20000, 1.2, 7)), true);
    EXPECT_EQ(term_with(result, "band_mm"), nullptr) << list(result);
    EXPECT_FALSE(tells(result, "a flight of steps")) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
