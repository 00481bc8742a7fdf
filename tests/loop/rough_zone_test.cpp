// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/rough_zone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>

#include "trueflank/loop/discovery/distributions.h"

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

/// The upper of the two in the middle.
double median_of(std::vector<double> sizes) {
  std::sort(sizes.begin(), sizes.end());
  return sizes[sizes.size() / 2];
}

/// What the header says, zone by zone: Student's test of the logarithms of the ratios of medians of
/// second differences, each at least as uncertain as medians of so many normal values are.
std::optional<loop::RoughZone> by_definition(const Courses& courses) {
  std::optional<loop::RoughZone> surest;
  double least_p = 1.0;
  int looks = 0;
  for (int from = 0; from < 12; ++from)
    for (int to = from + 2; to <= std::min(12, from + 8); ++to) {
      ++looks;
      const auto is_inside = [&](const ValueAlong& value) {
        const int part = std::min(11, static_cast<int>(12.0 * value.at));
        return from <= part && part < to;
      };
      std::vector<double> logs, sizes[2];
      double of_counts = 0.0;
      for (const auto& course : courses) {
        std::vector<double> bends[2];
        for (std::size_t i = 0; i < course.size(); ++i) {
          sizes[is_inside(course[i])].push_back(std::abs(course[i].um));
          if (i == 0 || i + 1 == course.size()) continue;
          const double slope = course[i].um - course[i - 1].um;
          bends[is_inside(course[i])].push_back(std::abs(course[i + 1].um - course[i].um - slope));
        }
        if (std::min(bends[0].size(), bends[1].size()) < 12) continue;
        const double inside = median_of(bends[1]), outside = median_of(bends[0]);
        if (inside == 0.0 || outside == 0.0) continue;
        logs.push_back(std::log(inside) - std::log(outside));
        for (const auto& one : bends) of_counts += 2.7 / static_cast<double>(one.size());
      }
      if (logs.size() < 4) continue;
      const double n = static_cast<double>(logs.size());
      const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / n;
      double variance = 0.0;
      for (const double one : logs) variance += std::pow(one - mean, 2) / (n - 1.0);
      const double error = std::sqrt(std::max(variance, of_counts / n) / n);
      const double p = 0.5 * loop::student_two_sided(mean / error, n - 1.0);
      if (std::exp(mean) < 1.7 || p >= least_p) continue;
      least_p = p;
      surest = {.from = from / 12.0,
                .to = to / 12.0,
                .inside_um = 1.4826 * median_of(sizes[1]),
                .outside_um = 1.4826 * median_of(sizes[0])};
    }
  if (surest) surest->p_value = std::min(1.0, looks * least_p);
  return surest;
}

TEST(RoughZone, IsWhatItsDefinitionSays) {
  int zones = 0, doubtful = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const double from = 0.1 * (seed % 6), to = from + 0.2 + 0.1 * (seed % 4);
    // every third time they differ from each other by more than chance makes them
    Courses courses;
    for (unsigned c = 0; c < 4 + seed % 2; ++c) {
      const double times = seed % 3 == 0 ? 1.5 + 4.0 * (c % 2) : 1.0 + 0.5 * (seed % 5);
      const auto loud = [&](double at) { return at >= from && at < to ? times : 1.0; };
      const int values = 50 + static_cast<int>(seed % 3) * 40;
      courses.push_back(courses_of(100 * seed + c, 1, values, 0.2, loud).front());
    }
    // one that says nothing, in the middle, and one that is shorter than the others
    if (seed % 4 != 0)
      courses.insert(courses.begin() + 1, std::vector<ValueAlong>(courses[0].size()));
    // and one that is nothing there, or nothing elsewhere
    if (seed % 5 < 2)
      for (ValueAlong& value : courses[2])
        value.um *= (value.at >= from && value.at < to) == (seed % 5 == 0) ? 0.0 : 1.0;
    if (seed % 2 == 0) courses.back().resize(courses.back().size() / 2);
    const auto told = rough_zone(courses), wanted = by_definition(courses);
    ASSERT_EQ(told.has_value(), wanted.has_value()) << seed;
    if (!told) continue;
    ++zones;
    doubtful += told->p_value == 1.0 ? 1 : 0;
    EXPECT_DOUBLE_EQ(told->from, wanted->from) << seed;
    EXPECT_DOUBLE_EQ(told->to, wanted->to) << seed;
    EXPECT_NEAR(told->inside_um, wanted->inside_um, 1e-12) << seed;
    EXPECT_NEAR(told->outside_um, wanted->outside_um, 1e-12) << seed;
    EXPECT_NEAR(told->p_value, wanted->p_value, 1e-9 * wanted->p_value) << seed;
  }
  EXPECT_GT(zones, 15);
  EXPECT_GT(doubtful, 0);
}

}  // namespace
}  // namespace trueflank::test
