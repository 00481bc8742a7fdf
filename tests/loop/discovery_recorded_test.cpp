// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "tests/loop/discovery_problems.h"
#include "tests/loop/recorded_findings.h"
#include "tests/support/recorded.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/block_statistics.h"
#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/ring_scan.h"
#include "trueflank/loop/discovery/structure_test.h"

namespace trueflank::loop {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %.5g", value);
  return text;
}

std::string told(const DiscoveryResult& r) {
  std::string text =
      number(r.first_p_value) + number(r.first_common_p_value) + number(r.p_left) +
      number(r.most_likely_left) +
      number(static_cast<double>(std::count(r.observable.begin(), r.observable.end(), true)));
  for (const ChosenGroup& c : r.chosen) {
    text += ';' + number(c.group) + number(c.p_value) + number(c.gain) + number(c.gain_error) +
            number(c.bic_gain);
    for (const int other : c.confounded) text += '=' + number(other);
  }
  return text;
}

std::string told(const StructureTest& t, int groups) {
  double sum = 0.0;
  for (int g = 0; g < groups; ++g) sum += (g + 1.0) * t.p_value_of(g);
  return number(t.p_value()) + number(sum) + number(t.most_likely()) +
         number(t.most_likely_single_p_value()) + number(t.local_p_value()) + number(t.most_likely_local());
}

std::string of_problem(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed) * 77u + 5u);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<std::pair<int, double>> groups;
  for (int k = pick(4); k > 0; --k) {  // drawn one by one: in a call each compiler has an order of its own
    const double size = 0.4 + 0.2 * pick(8);
    groups.emplace_back(pick(seed % 3 == 0 ? 24 : 12), size);
  }
  DiscoveryProblem problem = test::holding(groups, static_cast<unsigned>(seed));
  const int twin = pick(12), of = pick(12);
  if (seed % 4 == 1 && twin != of) {  // nearly the same
    const int a = problem.groups[static_cast<std::size_t>(twin)].first_column,
              b = problem.groups[static_cast<std::size_t>(of)].first_column;
    problem.candidates.col(a) = problem.candidates.col(b) + 0.05f * problem.candidates.col(a);
    problem.groups[static_cast<std::size_t>(of)].preference = pick(2);
    problem.groups[static_cast<std::size_t>(of)].complexity = pick(3);
  }
  if (seed % 5 == 2)
    for (std::size_t i = 0; i < problem.zero.size(); ++i)
      problem.zero[i] = i % 7 > 0 ? static_cast<int>(i % 7) - 1 : -1;
  if (seed % 2 == 1) {  // few wholes
    const int wholes = 3 + pick(6);
    for (int i = 0; i < 120; ++i)
      problem.whole.push_back(problem.unit[static_cast<std::size_t>(i)] % wholes);
  }
  if (seed % 6 == 4) {
    problem.anchor_fold = 5;
    for (std::size_t i = 0; i < 4; ++i) problem.fold[20 + i] = 5;
  }
  if (seed % 7 == 3)
    for (int g = 0; g < 6; ++g) problem.groups[static_cast<std::size_t>(g)].kin = g / 2;
  const BlockStatistics statistics(problem);
  return told(discover(problem, {.flips = 99})) + " |" +
         told(test::structure_beside(problem, statistics, {0, 1}, 49), 24);
}

/// Many groups that hang together, some the sum of two others, with preferences, kin and bans.
std::string of_hard_problem(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed) * 131u + 9u);
  std::normal_distribution<double> normal;
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int groups = 20 + pick(60), values = 160, common = groups - 10;
  DiscoveryProblem problem;
  int columns = 0;
  for (int g = 0; g < groups; ++g) {
    const int own = g < common && pick(3) == 0 ? 2 : 1;
    problem.groups.push_back({.first_column = columns,
                              .columns = own,
                              .preference = pick(3),
                              .local_family = g < common ? -1 : 0,
                              .kin = pick(5) == 0 ? pick(4) : -1,
                              .named = pick(4) > 0,
                              .complexity = static_cast<double>(pick(3))});
    columns += own;
  }
  const auto noise = [&] { return normal(random); };
  problem.value = Eigen::VectorXd::NullaryExpr(values, noise);
  problem.weight = Eigen::VectorXd::NullaryExpr(values, [&] { return 0.5 + std::abs(noise()); });
  problem.nuisance = Eigen::MatrixXd::NullaryExpr(values, 2, noise);
  problem.candidates =
      Eigen::MatrixXf::NullaryExpr(values, columns, [&] { return static_cast<float>(noise()); });
  for (int k = 1; k < columns; ++k)
    problem.candidates.col(k) += 0.8f * problem.candidates.col(k - 1);
  const auto first = [&](int g) {
    return problem.groups[static_cast<std::size_t>(g)].first_column;
  };
  const int a = pick(common), b = pick(common), both = pick(common);
  if (seed % 2 == 0 && both != a && both != b)
    problem.candidates.col(first(both)) =
        problem.candidates.col(first(a)) + problem.candidates.col(first(b));
  for (const int g : {a, b})
    problem.value += (0.5 + 0.1 * pick(12)) * problem.candidates.col(first(g)).cast<double>();
  for (int k = pick(5); k > 0; --k) {
    const int group = pick(groups);
    problem.value += 0.1 * pick(12) * problem.candidates.col(first(group)).cast<double>();
  }
  const int units = 12 + pick(30);
  for (int i = 0; i < values; ++i) {
    problem.unit.push_back(i * units / values);
    problem.fold.push_back(i * units / values % 6);
    problem.zero.push_back(seed % 3 == 0 ? i * units / values / 4 : -1);
    if (seed % 4 == 1) problem.whole.push_back(i * units / values % 7);
  }
  DiscoveryOptions options{.flips = 99, .most_effects = 1 + pick(8)};
  if (seed % 5 == 2)
    for (int g = 0; g < groups; ++g) options.banned.push_back(pick(4) == 0);
  const BlockStatistics statistics(problem);
  return told(discover(problem, options)) + " |" +
         told(test::structure_beside(problem, statistics, {0}, 49, options.banned), groups);
}

std::string of_ring(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  const int ring = 8 + static_cast<int>(random() % 30u),
            left_out = seed % 3 == 0 ? static_cast<int>(random() % 4u) : 0;
  std::vector<int> place;
  for (int i = 0; i < ring; ++i)
    if (!(left_out > 0 && i % 7 == left_out)) place.push_back(i);
  Eigen::MatrixXd series = Eigen::MatrixXd::NullaryExpr(
      static_cast<Eigen::Index>(place.size()), 1 + seed % 3, [&] { return normal(random); });
  const double size = 0.5 * static_cast<double>(random() % 12u);
  const int kind = static_cast<int>(random() % 4u), every = 2 + static_cast<int>(random() % 4u);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const int p = place[i];
    const double form = kind == 0   ? (p > 2 && p < 6 ? 1.0 : 0.0)
                        : kind == 1 ? std::cos(kTwoPi * every * p / ring)
                        : kind == 2 ? 2.0 * ((p + 5) % ring) / ring
                                    : (p % every == 1 ? 1.0 : 0.0);
    series(static_cast<Eigen::Index>(i), 0) += size * form;
  }
  const RingFinding f = scan_ring(series, place, ring);
  return number(static_cast<int>(f.kind)) + number(f.p_value) + number(f.series) + number(f.first) +
         number(f.count) + number(f.order) + number(f.amount);
}

std::string of_courses(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  const int rows = 12 + static_cast<int>(random() % 40u);
  std::vector<Eigen::MatrixXd> sets;
  for (int s = 0; s < 1 + seed % 3; ++s) {
    const int courses = seed % 11 == 5 && s == 0 ? 1 : 2 + static_cast<int>(random() % 6u);
    Eigen::MatrixXd set =
        Eigen::MatrixXd::NullaryExpr(rows, courses, [&] { return normal(random); });
    for (int i = 1; i < rows; ++i) set.row(i) += 0.5 * set.row(i - 1);
    const int kind = static_cast<int>(random() % 6u);
    const double size = 0.7 * static_cast<double>(random() % 8u),
                 at = 0.2 + 0.05 * static_cast<double>(random() % 12u);
    for (int i = 0; i < rows; ++i)
      for (int c = 0; c < courses; ++c) {
        const double x = (i + 0.5) / rows;
        set(i, c) += size * (kind == 0   ? (x > at ? 1.0 : 0.0)
                             : kind == 1 ? std::exp(-(x - at) * (x - at) / 0.01)
                             : kind == 2 ? std::cos(kTwoPi * (3.0 + 10.0 * at) * x)
                             : kind == 3 ? std::cos(kTwoPi * 7.0 * x + c)
                             : kind == 4 ? (c == 0 && std::abs(x - at) < 0.15 ? 2.0 : 0.0)
                                         : 0.0);
      }
    if (seed % 4 == 0) set.col(0) *= 3.0;
    set.rowwise() -= Eigen::RowVectorXd(set.colwise().mean());
    sets.push_back(std::move(set));
  }
  std::string text;
  for (const CourseFinding& f : scan_courses(sets))
    text += ";" + number(static_cast<int>(f.kind)) + number(f.p_value) + number(f.set) +
            number(f.course) + number(f.at) + number(f.width) + number(f.square) + number(f.amount);
  return text;
}

std::string of_seed(int seed) {
  const std::string text = seed >= 1000    ? of_hard_problem(seed - 1000)
                           : seed % 3 == 0 ? of_problem(seed / 3)
                           : seed % 3 == 1 ? of_ring(seed / 3)
                                           : of_courses(seed / 3);
  return text.substr(std::min(text.size(), text.find_first_not_of("; ")));
}

TEST(CourseScan, ASetWithoutCoursesSaysNothing) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd set = Eigen::MatrixXd::NullaryExpr(30, 4, [&] { return normal(random); });
  const auto alone = scan_courses({set}), beside = scan_courses({set, Eigen::MatrixXd(30, 0)});
  ASSERT_EQ(alone.size(), beside.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(beside[i].kind, alone[i].kind);
    EXPECT_EQ(beside[i].set, alone[i].set);
    EXPECT_EQ(beside[i].amount, alone[i].amount);
    EXPECT_FALSE(std::isnan(beside[i].p_value));
  }
}

TEST(DiscoveryFigures, OfRandomProblemsRingsAndCoursesAreThoseWrittenDown) {
  trueflank::test::expect_as_recorded(test::kRecordedFindings, of_seed);
}

}  // namespace
}  // namespace trueflank::loop
