// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// One form that goes from tooth to tooth, beside an eccentricity.
namespace trueflank::test {
namespace {

constexpr int kTeeth = 31;

struct FormAround {
  const char* words;
  double (*um)(int tooth, int side);
};

const std::vector<FormAround> kForms = {
    {"a sector of 13 teeth from tooth 9 on stands out",
     [](int tooth, int) { return tooth >= 9 && tooth <= 21 ? 2.4 : 0.0; }},
    {"from tooth 24 on, once around, the place of the teeth drifts evenly",
     [](int tooth, int side) { return side * 7.0 * ((tooth - 24 + kTeeth) % kTeeth) / kTeeth; }},
    {"from tooth 1 on, once around, the place of the teeth drifts and levels off",
     [](int tooth, int side) { return -side * 5.0 * std::exp(-(tooth - 1) / 6.0); }},
    {"begins anew every 10 teeth",
     [](int tooth, int) { return 0.4 * ((tooth - 4 + kTeeth) % kTeeth % 10); }},
    {"one tooth in 4", [](int tooth, int) { return tooth % 4 == 2 && tooth < 31 ? 3.0 : 0.0; }},
    {"3 hollows evenly spaced around the gear, one over a few teeth about tooth 5",
     [](int tooth, int) {
       double sum = 0.0;
       for (int k = 0; k < 3; ++k)
         sum -= 3.0 * std::exp(-std::pow(
                          std::remainder(tooth - 5.0 - k * kTeeth / 3.0, double{kTeeth}) / 1.8, 2));
       return sum;
     }},
    {"the height goes in steps: against teeth 1 to 9, teeth 10 to 20 stand out by",
     [](int tooth, int) { return tooth >= 21   ? 4.2
                                 : tooth >= 10 ? 2.4
                                               : 0.0; }},
    {"to 31 alone the place of the teeth drifts evenly, counter-clockwise, and jumps back",
     [](int tooth, int side) { return side * 0.4 * std::max(0, tooth - 14); }},
    {"once around, the teeth stand high and low in a wave of 1.",
     [](int tooth, int) { return 2.5 * std::cos(1.3 * 2.0 * M_PI * (tooth - 1) / kTeeth - 0.8); }},
    {"alone the teeth stand ahead and behind in waves of 6",
     [](int tooth, int side) {
       return tooth >= 5 && tooth <= 20 ? 2.5 * side * std::cos(6.0 * 2.0 * M_PI * tooth / kTeeth)
                                        : 0.0;
     }},
};

loop::LoopResult index_of(const FormAround& form, double eccentric_um, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.25;
  options.seed = seed;
  const auto own = [&](auto&, const FlankSpot& s, auto&) { return form.um(s.tooth, s.side); };
  std::vector<Process> processes{grown(own)};
  if (eccentric_um > 0.0) processes.push_back(off_centre(eccentric_um, 100.0));
  return close(spur(kTeeth), inspection_of(spur(kTeeth), processes, options));
}

TEST(FormsAround, StandAsOneFormBesideAnEccentricityInAnIndex) {
  for (const FormAround& form : kForms)
    for (const unsigned seed : survey_of(1, {1U, 2U, 3U})) {
      const auto result = index_of(form, 3.0, seed);
      EXPECT_EQ(result.effects.size(), 2U) << form.words << ": " << list(result);
      EXPECT_TRUE(tells(result, form.words)) << form.words << ": " << list(result);
      // (what waves left before the form stood in their place is gone)
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << form.words << ": " << list(result);
      const auto* found = find(result, "eccentricity");
      ASSERT_NE(found, nullptr) << form.words << ": " << list(result);
      EXPECT_NEAR(parameter(*found, "amplitude_um").value, 3.0, 0.35) << list(result);
      EXPECT_NEAR(parameter(*found, "phase_deg").value, 100.0, 6.0) << list(result);
    }
}

TEST(FormsAround, StandBesideAnEccentricityAndAWaveOfThePitch) {
  const auto sector = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth >= 12 && s.tooth <= 20 ? 4.0 * s.side : 0.0;
  };
  const auto drift = [](auto&, const FlankSpot& s, auto&) {
    return s.side > 0 ? 8.0 * (1.0 - std::exp(-(s.tooth - 1) / 15.0)) : 0.0;
  };
  const auto result_of = [](const Process& form, unsigned seed) {
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.5;
    options.seed = seed;
    return close(spur(kTeeth),
                 inspection_of(spur(kTeeth), {form, off_centre(4.0, 100.0), indexed(2, 5.0, 43.0)},
                               options));
  };
  for (const unsigned seed : survey_of(1, {1U, 2U, 3U}))
    for (const auto& [form, words] :
         {std::pair(grown(sector), "a sector of 9 teeth from tooth 12 on stands aside"),
          std::pair(grown(drift), "from tooth 1 on, once around, the height drifts")}) {
      const auto result = result_of(form, seed);
      EXPECT_EQ(result.effects.size(), 3U) << list(result);
      EXPECT_TRUE(tells(result, words)) << list(result);
      EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
      ASSERT_NE(find(result, "eccentricity"), nullptr) << list(result);
      EXPECT_NEAR(parameter(*find(result, "eccentricity"), "amplitude_um").value, 4.0, 0.6)
          << list(result);
      EXPECT_TRUE(tells(result, "pitch_wave") || tells(result, "twice per turn")) << list(result);
    }
}

TEST(FormsAround, AreNoNamesByThemselves) {
  for (const FormAround& form : kForms) {
    const auto result = index_of(form, 0.0, 5);
    EXPECT_EQ(result.effects.size(), 1U) << form.words << ": " << list(result);
    EXPECT_TRUE(tells(result, form.words)) << list(result);
    EXPECT_FALSE(has_name(result)) << list(result);
  }
}

/// Teeth of a cutter: any, and what they leave on the gear from its first tooth on.
std::vector<double> uneven_cutter(int teeth, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 3.0);
  std::vector<double> um(static_cast<std::size_t>(teeth));
  for (double& value : um) value = normal(random);
  return um;
}

TEST(FormsAround, APatternOfACuttersTeethIsOneFormWithItsValues) {
  struct Draw {
    int every, first;
    bool aside;
    double eccentric_um;
  };
  std::mt19937 random(20261129);
  for (const Draw& draw : {Draw{7, 1, true, 0.0}, Draw{5, 12, false, 3.0}, Draw{10, 27, true, 4.0},
                           Draw{3, 1, true, 0.0}}) {
    const std::vector<double> cutter = uneven_cutter(draw.every, random);
    const auto um_of = [&](int tooth) {
      return cutter[static_cast<std::size_t>((tooth - draw.first + kTeeth) % kTeeth % draw.every)];
    };
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.4;
    options.seed = static_cast<unsigned>(draw.every);
    std::vector<Process> processes{grown([&](auto&, const FlankSpot& s, auto&) {
      return um_of(s.tooth) * (draw.aside ? s.side : 1);
    })};
    if (draw.eccentric_um > 0.0) processes.push_back(off_centre(draw.eccentric_um, 100.0));
    const auto result = close(spur(kTeeth), inspection_of(spur(kTeeth), processes, options));
    const std::string told = list(result);
    EXPECT_EQ(result.effects.size(), draw.eccentric_um > 0.0 ? 2U : 1U) << told;
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << told;
    EXPECT_TRUE(tells(result, "a pattern that repeats every " + std::to_string(draw.every) +
                                  " teeth, from tooth " + std::to_string(draw.first)))
        << told;
    EXPECT_LT(result.noise, 0.55) << told;
    for (const loop::FoundEffect& found : result.effects) {
      if (found.named || found.terms.empty()) continue;
      const loop::Term& term = found.terms.front();
      ASSERT_EQ(term.shape.size(), 3U + cutter.size()) << told;
      double mean = 0.0;
      for (int tooth = 1; tooth <= kTeeth; ++tooth) mean += um_of(tooth) / kTeeth;
      for (std::size_t k = 0; k < cutter.size(); ++k)
        EXPECT_NEAR(term.cos * term.shape[3 + k], cutter[k] - mean, 0.75) << k << ": " << told;
    }
  }
}

TEST(FormsAround, PlacesOfTheirOwnAreNoPattern) {
  std::mt19937 random(7);
  for (int draw = 0; draw < survey_size(3, 8); ++draw) {
    const std::vector<double> own = uneven_cutter(kTeeth, random);
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.4;
    options.seed = 100U + static_cast<unsigned>(draw);
    const auto result = close(
        spur(kTeeth), inspection_of(spur(kTeeth), {grown([&](auto&, const FlankSpot& s, auto&) {
                                      return s.side * own[static_cast<std::size_t>(s.tooth - 1)];
                                    })},
                                    options));
    EXPECT_FALSE(tells(result, "a pattern that repeats")) << list(result);
  }
}

TEST(FormsAround, WhatAnIndexShowsStandsInPlaceOfNamesThatTracesWouldKeep) {
  // Four traced teeth: the drift of their slopes could be anything.
  InspectionOptions options;
  options.teeth = {1, 9, 17, 25};
  options.helix = false;
  options.points = 60;
  options.noise_um = 0.4;
  options.seed = 3;
  const auto drift = [](auto&, const FlankSpot& s, auto&) { return kForms[1].um(s.tooth, s.side); };
  const auto result = close(
      spur(kTeeth), inspection_of(spur(kTeeth), {grown(drift), off_centre(4.0, 20.0)}, options));
  EXPECT_TRUE(tells(result, kForms[1].words)) << list(result);
  const auto* found = find(result, "eccentricity");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_NEAR(parameter(*found, "amplitude_um").value, 4.0, 0.6) << list(result);
  EXPECT_EQ(result.effects.size(), 2U) << list(result);
}

TEST(FormsAround, AWaveOfAnIndexKeepsItsName) {
  for (const unsigned seed : survey_of(3, {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U})) {
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.6;
    options.seed = seed;
    const auto result =
        close(spur(kTeeth), inspection_of(spur(kTeeth), {indexed(2, 2.0, 30.0)}, options));
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_EQ(result.effects[0].id, "pitch_wave") << list(result);
  }
}

TEST(FormsAround, SinksOfAScanAreNoThinnerTeeth) {
  const auto sinks = [](auto&, const FlankSpot& s, auto&) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum -= 14.0 * std::exp(-std::pow(std::remainder(s.tooth - 8.0 - k * 12.0, 36.0) / 1.8, 2));
    return sum;
  };
  const auto result =
      close(spur(36), scan_of(spur(36), {grown(sinks)}, scanned(6000, 2.0, 7)), true);
  EXPECT_TRUE(tells(result, "3 hollows evenly spaced around the gear")) << list(result);
  EXPECT_FALSE(has_name(result)) << list(result);
  EXPECT_EQ(result.effects.size(), 1U) << list(result);
}

TEST(FormsAround, EveryThirdToothOfAScanIsNoWaveBesideThickerTeeth) {
  for (const int first : survey_of(1, {1, 2})) {
    const auto third = [&](auto&, const FlankSpot& s, auto&) {
      return s.tooth % 3 == first ? 20.0 : 0.0;
    };
    const auto result = close(
        spur(27), scan_of(spur(27), {grown(third), off_centre(15.0, 30.0)}, scanned(6000, 2.5, 9)),
        true);
    EXPECT_TRUE(tells(result, "one tooth in 3, from tooth " + std::to_string(first)))
        << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
    EXPECT_NE(find(result, "eccentricity"), nullptr) << list(result);
  }
}

// Half a wave stands out to one way: that is said, and on which tooth most.
TEST(FormsAround, HalfAWaveOfSomeTeethSaysWhichWay) {
  const auto g = geometry_of(spur(24));
  const auto* waves = loop::find_family("unnamed_wave_of_some");
  const auto told_of = [&](double periods, double opposite, const std::vector<double>& amounts) {
    const loop::EffectShape shape{5, 9, periods, opposite};
    return waves->words({g, shape, loop::FlankChoice::kBoth, amounts});
  };
  EXPECT_THAT(
      told_of(1.5, 0, {0.0, 3.0}),
      testing::HasSubstr("over teeth 5 to 13 alone the teeth stand out, most about tooth 9"));
  EXPECT_THAT(told_of(1.5, 0, {0.0, -3.0}),
              testing::HasSubstr("the teeth lie back, most about tooth 9"));
  EXPECT_THAT(told_of(1.5, 1, {0.0, 3.0}),
              testing::HasSubstr("stand aside, counter-clockwise, most"));
  EXPECT_THAT(told_of(1.5, 1, {0.0, -3.0}), testing::HasSubstr("stand aside, clockwise, most"));
  EXPECT_THAT(told_of(3.0, 1, {0.0, 3.0}),
              testing::HasSubstr("ahead and behind in waves of 3 a turn"));
}

}  // namespace
}  // namespace trueflank::test
