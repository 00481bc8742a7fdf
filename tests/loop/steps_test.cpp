// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/loop/made_gears.h"

// Steps along the flanks whose edge has a length, as layer borders and work that slips have. Their
// edges are made otherwise than the library's: an error function, a ramp.
namespace trueflank::test {
namespace {

/// From 0 to 1 about a place, from a tenth to nine tenths over such a length.
double eased(double off, double length) { return 0.5 * (1.0 + std::erf(1.8124 * off / length)); }
double ramp(double off, double length) { return std::clamp(0.5 + off / length, 0.0, 1.0); }

Process stepped(double um, double at, double edge, bool opposite,
                double (*course)(double, double) = eased) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    return um * (opposite ? s.side : 1) * course(s.v - at, edge);
  });
}

/// The edge that a step is told with [mm]; 0: none.
double told_edge_mm(const loop::LoopResult& result) {
  std::smatch found;
  const std::string text = list(result);
  return std::regex_search(text, found, std::regex("a step over[^,]*, over ([0-9.]+) mm"))
             ? std::stod(found[1])
             : 0.0;
}
void expect_step(const loop::LoopResult& result, const std::string& words, std::size_t effects,
                 loop::Verdict verdict = loop::Verdict::kExplained) {
  EXPECT_TRUE(tells(result, "a step over")) << list(result);
  EXPECT_TRUE(tells(result, words)) << list(result);
  EXPECT_EQ(result.effects.size(), effects) << list(result);
  EXPECT_EQ(result.verdict, verdict) << list(result);
}

TEST(SoftStep, OfScansIsOneFormWithTheLengthOfItsEdge) {
  for (const MadeGear& gear : {spur(29), helical(24, 18.0)})
    for (const double edge : {0.14, 0.26}) {  // of half the face
      if (!is_surveyed((gear.helix_rad == 0.0) == (edge < 0.2))) continue;
      const auto result = close(
          gear, scan_of(gear, {stepped(20.0, 0.24, edge, true)}, scanned(8000, 2.5, 21)), true);
      expect_step(result, "opposite on the two flanks: above it the teeth stand counter-clockwise",
                  1);
      // A logistic course of the same spread is 0.86 times as long as the error function, one as
      // steep in the middle 0.98 times.
      const double made_mm = 0.5 * edge * gear.face_mm;
      EXPECT_GT(told_edge_mm(result), 0.82 * made_mm);
      EXPECT_LT(told_edge_mm(result), 1.02 * made_mm);
      EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 20.0, 0.6) << list(result);
    }
}

TEST(SoftStep, OfTracesIsOneForm) {
  const MadeGear gear = spur(28);
  const std::vector<int> few{1, 10, 19}, all;
  for (const auto course : {eased, ramp})
    for (const std::vector<int>& teeth : {few, all}) {
      const auto result = close(gear, inspection_of(gear, {stepped(4.0, 0.3, 0.3, true, course)},
                                                    traced(teeth, 0.5, 22)));
      // The corners of a ramp are seen where all teeth show them, and said to be left.
      expect_step(result, "opposite on the two flanks", 1,
                  course == ramp && teeth.empty() ? loop::Verdict::kPartlyExplained
                                                  : loop::Verdict::kExplained);
      EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 4.0, 0.2) << list(result);
    }
}

TEST(SoftStep, StandsBesideNames) {
  const MadeGear gear = spur(28);
  const Process names =
      grown([](auto&, const FlankSpot& s, auto&) { return 3.5 * s.v - 5.5 * s.v * s.v; });
  const auto result = close(
      gear, inspection_of(gear, {names, stepped(-2.6, -0.35, 0.2, true)}, traced({}, 0.7, 23)));
  expect_step(result, "above it the teeth stand clockwise", 3);
  expect_size(result, "taper", "slope_um", 7.0, 0.5);
  expect_size(result, "crowning", "amount_um", 5.5, 0.5);
}

TEST(SoftStep, OfBothFlanksAlikeStandsBesideALevel) {
  const MadeGear gear = spur(15);
  const auto result = close(
      gear,
      scan_of(gear,
              {stepped(-5.6, -0.1, 0.2, false), grown([](auto&, auto&, auto&) { return 5.6; })},
              scanned(5000, 1.0, 24)),
      true);
  EXPECT_TRUE(tells(result, "a step over the face")) << list(result);
  EXPECT_TRUE(tells(result, "above it the flanks lie back")) << list(result);
  EXPECT_LE(result.effects.size(), 2U) << list(result);
}

TEST(SoftStep, TowardsAnEndStandsBesideALevelAndALead) {
  const MadeGear gear = spur(31);
  const Process lead = grown([](auto&, const FlankSpot&s, auto&) { return -4.1 * s.side * s.v; }),
                level = grown([](auto&, auto&, auto&) { return 5.6; });
  for (const unsigned seed : survey_of(1, {1U, 2U})) {
    const auto result = close(
        gear,
        scan_of(gear, {lead, level, stepped(-5.6, -0.57, 0.15, false)}, scanned(5000, 1.1, seed)),
        true);
    expect_step(result, "above it the flanks lie back", 3);
    expect_size(result, "helix_error", "slope_um", -8.2, 0.3);
  }
}

// What is no step: a sharp one has no edge, and what runs all over the face bends.
TEST(SoftStep, IsNotMadeOfASharpOneNorOfAnS) {
  const MadeGear gear = spur(27);
  const auto sharp =
      close(gear, scan_of(gear, {stepped(20.0, 0.2, 1e-6, false)}, scanned(8000, 2.5, 25)), true);
  EXPECT_TRUE(tells(sharp, "a step over the face")) << list(sharp);
  EXPECT_EQ(told_edge_mm(sharp), 0.0) << list(sharp);
  const auto s = close(gear,
                       scan_of(gear, {grown([](auto&, const FlankSpot& f, auto&) {
                                 return 12.0 * (f.v * f.v * f.v - 0.5 * f.v);
                               })},
                               scanned(8000, 1.5, 26)),
                       true);
  EXPECT_FALSE(tells(s, "a step")) << list(s);
  // What dies away from an end rises towards it.
  const auto end = close(gear, inspection_of(gear, {grown([](auto&, const FlankSpot& f, auto&) {
                                               return 6.0 * f.side * std::exp(-(1.0 - f.v) / 0.19);
                                             })},
                                             traced({1, 7, 14, 21}, 0.4, 27)));
  EXPECT_FALSE(tells(end, "a step")) << list(end);
}

int times_told(const loop::LoopResult& result, const std::string& words) {
  const std::string text = list(result);
  int count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++count;
  return count;
}

// Plates of one gear that are turned against each other.
TEST(SeveralSteps, AreEachToldWithHeightAndSize) {
  const MadeGear gear = spur(29);
  const auto result =
      close(gear,
            scan_of(gear, {stepped(21.0, -0.3, 1e-6, true), stepped(14.5, 0.3, 1e-6, true)},
                    scanned(2000, 2.0, 31)),
            true);
  for (const std::string height : {"3.5", "6.5"})
    EXPECT_TRUE(tells(result, "at a height of " + height +
                                  " mm, opposite on the two flanks: above it the teeth stand "
                                  "counter-clockwise"))
        << list(result);
  EXPECT_EQ(times_told(result, "the same on every tooth"), 2) << list(result);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
}

// A filament that snags: the wall sinks at once and recovers.
TEST(FadingJump, IsOneForm) {
  const MadeGear gear = spur(28);
  const Process snag = grown([](auto&, const FlankSpot& s, auto&) {
    const double off = s.v + 0.2;
    return off > 0.0 ? -10.0 * std::exp(-off / 0.4) : 0.0;
  });
  const auto result = close(gear, inspection_of(gear, {snag}, traced({1, 10, 19}, 0.8, 32)));
  EXPECT_TRUE(tells(result, "that dies away towards the upper end, within 1.9")) << list(result);
  EXPECT_TRUE(tells(result, "behind it the flanks lie back")) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

// Material that flows more to one side: on every tooth alike, so of no order around the gear.
TEST(SkewedBand, OfOppositeFlanksIsOneForm) {
  const MadeGear gear = spur(30);
  const Process rolled = grown([](auto&, const FlankSpot& s, auto&) {
    const double off = s.u / (s.u < 0.0 ? 0.25 : 0.6);
    return s.side * 10.0 * std::exp(-off * off);
  });
  const auto result =
      close(gear, inspection_of(gear, {rolled}, traced({1, 6, 11, 16, 21, 26}, 0.6, 34)));
  EXPECT_TRUE(tells(result, "a groove or ridge over the profile")) << list(result);
  EXPECT_TRUE(tells(result, "there the teeth stand counter-clockwise")) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

// An axial slide that sticks and slips.
TEST(Sawtooth, IsOneFormAndNoLead) {
  const MadeGear gear = spur(28);
  for (const bool opposite : {true, false}) {
    const auto saw = grown([=](auto&, const FlankSpot& s, auto&) {
      const double at = 1.9 * s.v + 0.3;
      return (opposite ? s.side : 1) * 8.0 * (2.0 * (at - std::floor(at)) - 1.0);
    });
    const auto result = close(gear, scan_of(gear, {saw}, scanned(2500, 2.0, 33)), true);
    EXPECT_TRUE(tells(result, "a sawtooth over the face, period")) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NEAR(std::abs(parameter(result.effects[0], "amplitude_um").value), 16.0, 0.5)
        << list(result);
  }
}

// A model that was exported as a polygon: its edges lie on the flank, its facets behind it.
TEST(Facets, AreOneFormAndNoThinnerTeeth) {
  const MadeGear gear = spur(28);
  struct Draw {
    double facets, sagitta_um;
  };
  for (const Draw& draw : survey_of(1, {Draw{5.0, 16.0}, Draw{7.0, 9.0}, Draw{3.0, 25.0}})) {
    const auto polygon = grown([&](auto&, const FlankSpot& s, auto&) {
      const double at = 0.5 * (s.u + 1.0) * draw.facets, within = at - std::floor(at);
      return -draw.sagitta_um * 4.0 * within * (1.0 - within);
    });
    const auto result = close(gear, scan_of(gear, {polygon}, scanned(6000, 2.0, 33)), true);
    EXPECT_TRUE(tells(result, "facets over the profile, each")) << list(result);
    EXPECT_TRUE(tells(result, "between the edges the flanks lie back")) << list(result);
    EXPECT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_NEAR(std::abs(parameter(result.effects[0], "amplitude_um").value), draw.sagitta_um,
                0.05 * draw.sagitta_um)
        << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
