// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/loud_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/discovery/course_scan.h"

namespace trueflank::test {
namespace {

using loop::FlankPart;
using loop::loud_places;
using loop::LoudPlace;

constexpr int kLoudTeeth = 24, kProfiles = 12, kFaces = 10;

/// Normal errors, as loud as `loud` says, on a form.
std::vector<FlankPart> parts_of(unsigned seed, const std::function<double(const FlankPart&)>& loud,
                                const std::function<double(const FlankPart&)>& form) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<FlankPart> parts;
  for (int tooth = 1; tooth <= kLoudTeeth; ++tooth)
    for (const std::size_t side : {0U, 1U})
      for (int u = 0; u < kProfiles; ++u)
        for (int v = 0; v < kFaces; ++v) {
          FlankPart part{tooth, side, u, v, 0.0, 1.0};
          part.um = form(part) + loud(part) * normal(random);
          parts.push_back(part);
        }
  return parts;
}
double even(const FlankPart&) { return 1.0; }
double flat(const FlankPart&) { return 0.0; }

TEST(LoudPlaces, AreFoundWhereTheyAreAndAsLoudAsTheyAre) {
  const auto edges = [](const FlankPart& p) {
    return (p.profile >= 10 ? 3.0 : 1.0) * (p.face == 0 && p.side == 1 ? 4.0 : 1.0) *
           (p.tooth == 7 && p.side == 0 ? 4.0 : 1.0);
  };
  // Logarithms of medians of some 240, 240 and 100 differences: a standard error of 0.2 together.
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<FlankPart> parts = parts_of(seed, edges, flat);
    const auto found = loud_places(parts);
    for (std::size_t i = 0; i < parts.size(); ++i)
      EXPECT_NEAR(std::log(found.factors[i] / edges(parts[i])), 0.0, 0.6)
          << "tooth " << parts[i].tooth << " side " << parts[i].side << " profile "
          << parts[i].profile << " face " << parts[i].face;
    const auto told = [&](LoudPlace::Of of, std::size_t side, int first, int last, double times) {
      return std::any_of(found.places.begin(), found.places.end(), [&](const LoudPlace& place) {
        return place.of == of && place.side == side && place.first == first && place.last == last &&
               std::abs(place.times - times) < 0.3 * times && place.p_value < 1e-3;
      });
    };
    EXPECT_EQ(found.places.size(), 4U) << seed;
    EXPECT_TRUE(told(LoudPlace::Of::kProfile, 0, 10, 11, 3.0)) << seed;
    EXPECT_TRUE(told(LoudPlace::Of::kProfile, 1, 10, 11, 3.0)) << seed;
    EXPECT_TRUE(told(LoudPlace::Of::kFace, 1, 0, 0, 4.0)) << seed;
    EXPECT_TRUE(told(LoudPlace::Of::kFlank, 0, 7, 7, 4.0)) << seed;
  }
}

bool all_even(const std::vector<FlankPart>& parts) {
  const auto found = loud_places(parts);
  return found.places.empty() && std::all_of(found.factors.begin(), found.factors.end(),
                                             [](double factor) { return factor == 1.0; });
}

TEST(LoudPlaces, AreNoneOfEvenNoise) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    EXPECT_TRUE(all_even(parts_of(seed, even, flat))) << seed;
  EXPECT_TRUE(all_even({}));
}

TEST(LoudPlaces, AreNoneWhereTheSurfaceHasAForm) {
  // A steep relief and waves of all flanks; a slow form of its own on every tooth; a burr on one.
  const auto relief = [](const FlankPart& p) {
    return -20.0 * std::pow(std::max(0, p.profile - 7), 2) + 15.0 * std::cos(2.5 * p.face);
  };
  const auto own = [](const FlankPart& p) {
    return 30.0 * std::sin(1.3 * p.tooth) * (p.profile / 6.0 - 1.0);
  };
  const auto burr = [](const FlankPart& p) {
    return p.tooth == 5 && std::abs(p.profile - 6) < 2 && p.face < 3 ? 40.0 : 0.0;
  };
  for (const auto& form : {std::function<double(const FlankPart&)>(relief), {own}, {burr}})
    for (unsigned seed = 1; seed <= 5; ++seed)
      EXPECT_TRUE(all_even(parts_of(seed, even, form))) << seed;
}

/// A scan without an effect whose error is `loud` times the usual one.
loop::LoopResult of_scan(const MadeGear& gear, unsigned seed, bool aligned,
                         const std::function<double(const FlankSpot&)>& loud) {
  std::mt19937_64 random(1000 + seed);
  std::normal_distribution<double> normal;
  const auto error = [&](auto&, const FlankSpot& s, auto&) {
    return 2.0 * loud(s) * normal(random);
  };
  return close(gear, scan_of(gear, {grown(error)}, scanned(9000, 0.0, seed)), aligned);
}

TEST(LoudPlaces, OfAScanAreNoSpotsAndNoEffects) {
  const MadeGear gear = spur(29);
  const auto tip = [](const FlankSpot& s) { return s.u > 0.84 ? 3.5 : 1.0; };
  const auto ends = [](const FlankSpot& s) { return std::abs(s.v) > 0.8 ? 3.0 : 1.0; };
  const auto tooth = [](const FlankSpot& s) { return s.tooth == 3 ? 3.5 : 1.0; };
  unsigned alarms = 0;
  const unsigned all = survey_size(2U, 4U);
  std::string told;
  for (unsigned seed = 1; seed <= all; ++seed)
    for (const auto& loud : {std::function<double(const FlankSpot&)>(tip), {ends}, {tooth}}) {
      const auto result = of_scan(gear, seed, seed % 2 == 0, loud);
      if (result.verdict != loop::Verdict::kNoEffect) {
        ++alarms;
        told += list(result) + "\n";
      }
      EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const auto& note) {
        return note.find("scatter") != std::string::npos;
      })) << seed;
    }
  EXPECT_LE(4 * alarms, 1 * all) << told;
}

TEST(LoudPlaces, LouderFlanksOfASparseScanHaveNoFormOfTheirOwn) {
  const MadeGear gear = spur(67);
  const auto teeth = [](const FlankSpot& s) { return s.tooth % 13 == 3 ? 2.5 : 1.0; };
  std::string told;
  for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed) {
    const auto result = of_scan(gear, seed, true, teeth);
    if (tells(result, "a form of its own")) told += list(result) + "\n";
  }
  EXPECT_EQ(told, "");
}

TEST(LoudPlaces, OfAScanThatAreFarLouderAreARoughSurface) {
  const MadeGear gear = spur(29);
  const auto torn = [](const FlankSpot& s) { return s.v > 0.3 ? 8.0 : 1.0; };
  const auto result = of_scan(gear, 5, true, torn);
  EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
  EXPECT_NE(result.structure_left.find("rougher on all flanks between heights of"),
            std::string::npos)
      << list(result);
  EXPECT_FALSE(has_name(result)) << list(result);
}

TEST(LoudPlaces, AStepWithinAPatchIsNoScatter) {
  const MadeGear gear = spur(29);
  const auto step = [](auto&, const FlankSpot& s, auto&) { return s.v > 0.12 ? 12.0 : 0.0; };
  for (unsigned seed = 1; seed <= survey_size(1U, 2U); ++seed) {
    const auto result =
        close(gear, scan_of(gear, {grown(step)}, scanned(9000, 0.6, seed)), seed > 1);
    EXPECT_EQ(result.structure_left.find("rougher"), std::string::npos) << list(result);
    EXPECT_TRUE(std::none_of(result.notes.begin(), result.notes.end(), [](const auto& note) {
      return note.find("scatter") != std::string::npos;
    })) << list(result);
  }
}

TEST(LoudPlaces, OneOfTwoSetsOfCoursesMayBeLouder) {
  // Three traces of either flank: too few to tell how windows of a set scatter.
  int alarms = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Eigen::MatrixXd> sets{Eigen::MatrixXd(120, 3), Eigen::MatrixXd(120, 3)};
    for (std::size_t s = 0; s < sets.size(); ++s)
      for (double& value : sets[s].reshaped()) value = (s == 0 ? 1.0 : 4.0) * normal(random);
    for (const auto& found : loop::scan_courses(sets)) alarms += found.p_value < 1e-3 ? 1 : 0;
  }
  EXPECT_LE(alarms, 2);
}

TEST(LoudPlaces, AToothThatIsMeasuredWorseDoesNotAgreeWithItself) {
  const MadeGear gear = spur(31);
  InspectionOptions options;
  for (int tooth = 1; tooth <= gear.teeth; ++tooth) options.teeth.push_back(tooth);
  options.points = 60;
  options.noise_um = 0.2;
  options.index = false;
  int alarms = 0;
  std::string told;
  for (unsigned seed = 1; seed <= survey_size(2U, 6U); ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto error = [&](auto&, const FlankSpot& s, auto&) {
      return (s.tooth == 8 ? 6.0 : 1.0) * normal(random);
    };
    options.seed = seed;
    const auto result = close(gear, inspection_of(gear, {grown(error)}, options));
    if (result.structure_left.find("of its own on every tooth") == std::string::npos) continue;
    ++alarms;
    told += list(result) + "\n";
  }
  EXPECT_EQ(alarms, 0) << told;
}

TEST(RoughZone, OfTornFlanksIsToldAndNoSpots) {
  const MadeGear gear = spur(31);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto torn = [&](auto&, const FlankSpot& s, auto&) {
      return s.v > 0.3 ? 8.0 * normal(random) : 0.0;
    };
    InspectionOptions options;
    options.teeth = {1, 9, 17, 24};
    options.points = 120;
    options.noise_um = 1.6;
    options.index = false;
    options.seed = seed;
    const auto result = close(gear, inspection_of(gear, {grown(torn)}, options));
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_NE(result.structure_left.find("rougher between heights of"), std::string::npos)
        << list(result);
    EXPECT_FALSE(tells_spot(result)) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
