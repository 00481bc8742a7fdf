// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/rough_zone.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

constexpr int kTwelfths = 12, kShortestZone = 2, kLongestZone = 8;
constexpr std::size_t kFewestCourses = 4, kFewestSizes = 12;

/// Sizes by the part of the course in which they stand.
using ByPart = std::array<std::vector<double>, kTwelfths>;

std::size_t part_of(double at) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(at * kTwelfths), 0, kTwelfths - 1));
}

ByPart bends_of(const std::vector<ValueAlong>& course) {
  ByPart sizes;
  for (std::size_t i = 1; i + 1 < course.size(); ++i)
    sizes[part_of(course[i].at)].push_back(
        std::abs(course[i - 1].um - 2.0 * course[i].um + course[i + 1].um));
  return sizes;
}

ByPart sizes_of(const std::vector<ValueAlong>& course) {
  ByPart sizes;
  for (const ValueAlong& value : course) sizes[part_of(value.at)].push_back(std::abs(value.um));
  return sizes;
}

struct Zone {
  int from = 0, to = 0;
  [[nodiscard]] bool has(int part) const { return part >= from && part < to; }
};

struct TwoMedians {
  double inside = 0.0, outside = 0.0;
  std::size_t count_inside = 0, count_outside = 0;
};
TwoMedians medians_of(const ByPart& sizes, const Zone& zone) {
  std::vector<double> inside, outside;
  for (int part = 0; part < kTwelfths; ++part) {
    const std::vector<double>& own = sizes[static_cast<std::size_t>(part)];
    std::vector<double>& to = zone.has(part) ? inside : outside;
    to.insert(to.end(), own.begin(), own.end());
  }
  TwoMedians result{.count_inside = inside.size(), .count_outside = outside.size()};
  if (inside.size() < kFewestSizes || outside.size() < kFewestSizes) return result;
  result.inside = median(inside);
  result.outside = median(outside);
  return result;
}

/// How sure the courses are of a zone, and by what factor values differ more there, and at least.
struct Sureness {
  double p_value = 1.0, ratio = 0.0, at_least = 0.0;
};
Sureness sureness_of(const std::vector<ByPart>& courses, const Zone& zone) {
  // Variance of the logarithm of a median of sizes, times their number; second differences share
  // values.
  constexpr double kOfMedian = 2.7, kErrors = 2.0;
  std::vector<double> logs;
  double by_chance = 0.0;
  for (const ByPart& course : courses) {
    const TwoMedians medians = medians_of(course, zone);
    if (!(medians.inside > 0.0 && medians.outside > 0.0)) continue;
    logs.push_back(std::log(medians.inside / medians.outside));
    by_chance += kOfMedian * (1.0 / static_cast<double>(medians.count_inside) +
                              1.0 / static_cast<double>(medians.count_outside));
  }
  if (logs.size() < kFewestCourses) return {};
  const auto n = static_cast<double>(logs.size());
  double mean = 0.0, square = 0.0;
  for (const double log : logs) mean += log / n;
  for (const double log : logs) square += (log - mean) * (log - mean) / (n - 1.0);
  const double error = std::sqrt(std::max(square, by_chance / n) / n);
  return {0.5 * student_two_sided(mean / error, n - 1.0), std::exp(mean),
          std::exp(mean - kErrors * error)};
}

}  // namespace

std::optional<RoughZone> rough_zone(const std::vector<std::vector<ValueAlong>>& courses) {
  constexpr double kLeastRatio = 1.7;
  if (courses.size() < kFewestCourses) return {};
  std::vector<ByPart> bends;
  for (const std::vector<ValueAlong>& course : courses) bends.push_back(bends_of(course));
  Sureness surest;
  Zone zone;
  int looks = 0;
  for (int from = 0; from < kTwelfths; ++from)
    for (int to = from + kShortestZone; to <= std::min(kTwelfths, from + kLongestZone); ++to) {
      ++looks;
      const Sureness own = sureness_of(bends, {from, to});
      if (own.ratio < kLeastRatio || own.p_value >= surest.p_value) continue;
      surest = own;
      zone = {from, to};
    }
  if (!(surest.ratio > 0.0)) return {};
  ByPart all;
  for (const std::vector<ValueAlong>& course : courses) {
    ByPart sizes = sizes_of(course);
    for (std::size_t part = 0; part < all.size(); ++part)
      all[part].insert(all[part].end(), sizes[part].begin(), sizes[part].end());
  }
  const TwoMedians um = medians_of(all, zone);
  return RoughZone{.from = static_cast<double>(zone.from) / kTwelfths,
                   .to = static_cast<double>(zone.to) / kTwelfths,
                   .inside_um = kSigmaOfMedianSize * um.inside,
                   .outside_um = kSigmaOfMedianSize * um.outside,
                   .at_least = surest.at_least,
                   .p_value = std::min(1.0, looks * surest.p_value)};
}

}  // namespace trueflank::loop
