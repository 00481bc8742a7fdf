// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/rough_zone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

using loop::rough_zone;
using loop::ValueAlong;
using Courses = std::vector<std::vector<ValueAlong>>;

/// Normal values, each hanging on the one before by `rho`, as loud as `loud` says.
Courses courses_of(unsigned seed, int count, int values, double rho,
                   const std::function<double(double at)>& loud) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Courses courses;
  for (int c = 0; c < count; ++c) {
    std::vector<ValueAlong>& course = courses.emplace_back();
    double error = normal(random);
    for (int i = 0; i < values; ++i) {
      const double at = i / (values - 1.0);
      course.push_back({at, loud(at) * error});
      error = rho * error + std::sqrt(1.0 - rho * rho) * normal(random);
    }
  }
  return courses;
}

TEST(RoughZone, IsFoundWhereItIsAndAsLoudAsItIs) {
  const auto torn = [](double at) { return at > 2.0 / 3.0 ? 6.0 : 2.0; };
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto zone = rough_zone(courses_of(seed, 8, 120, 0.4, torn));
    ASSERT_TRUE(zone.has_value()) << seed;
    EXPECT_LT(zone->p_value, 1e-3) << seed;
    EXPECT_NEAR(zone->from, 2.0 / 3.0, 0.1) << seed;
    EXPECT_NEAR(zone->to, 1.0, 0.1) << seed;
    EXPECT_NEAR(zone->inside_um, 6.0, 1.0) << seed;
    EXPECT_NEAR(zone->outside_um, 2.0, 0.4) << seed;
  }
}

TEST(RoughZone, IsSeldomFoundWhereThereIsNone) {
  constexpr unsigned kRuns = 400;
  int alarms = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const int courses = 4 + 4 * static_cast<int>(seed % 4),
              values = 40 + 40 * static_cast<int>(seed % 3);
    const auto zone = rough_zone(
        courses_of(1000 + seed, courses, values, 0.2 * (seed % 5), [](double) { return 1.0; }));
    alarms += zone && zone->p_value < 0.004 ? 1 : 0;
  }
  EXPECT_LE(alarms, 4);
}

TEST(RoughZone, IsNoneWhereSingleCoursesAreRoughAtPlacesOfTheirOwn) {
  Courses courses;
  for (unsigned c = 0; c < 8; ++c) {
    const double place = 0.1 + 0.1 * c;
    courses.push_back(courses_of(50 + c, 1, 120, 0.0, [&](double at) {
                        return std::abs(at - place) < 0.12 ? 4.0 : 1.0;
                      }).front());
  }
  const auto zone = rough_zone(courses);
  EXPECT_TRUE(!zone || zone->p_value > 0.004);
}

TEST(RoughZone, OfASpotOnEveryCourseIsNone) {
  Courses courses = courses_of(3, 8, 120, 0.0, [](double) { return 1.0; });
  for (auto& course : courses)
    for (ValueAlong& value : course) value.um += std::abs(value.at - 0.4) < 0.02 ? 20.0 : 0.0;
  const auto zone = rough_zone(courses);
  EXPECT_TRUE(!zone || zone->p_value > 0.004);
}

TEST(RoughZone, OfTooFewOrTooShortCoursesIsNone) {
  const auto torn = [](double at) { return at > 0.5 ? 9.0 : 1.0; };
  EXPECT_FALSE(rough_zone({}).has_value());
  EXPECT_FALSE(rough_zone(courses_of(1, 3, 120, 0.0, torn)).has_value());
  EXPECT_FALSE(rough_zone(courses_of(1, 8, 12, 0.0, torn)).has_value());
  EXPECT_FALSE(rough_zone(Courses(8)).has_value());
  EXPECT_FALSE(rough_zone(courses_of(1, 8, 120, 0.0, [](double) { return 0.0; })).has_value());
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
    EXPECT_EQ(list(result).find("a spot on"), std::string::npos) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
