// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/rougher_members.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::test {
namespace {

/// Scatters of `teeth` members on either side, told from `values` differences each.
std::vector<loop::MemberScatter> scatters(unsigned seed, int teeth, double values,
                                          const std::function<double(int tooth)>& loud) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> log(0.0, std::sqrt(2.5 / values));
  std::vector<loop::MemberScatter> all;
  for (int tooth = 1; tooth <= teeth; ++tooth)
    for (const int set : {0, 1})
      all.push_back({tooth, set, loud(tooth) * std::exp(log(random)), values});
  return all;
}

TEST(RougherMembers, TellAGrowthAndARunWithTheirSizes) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto grows = loop::rougher_members(
        scatters(seed, 30, 60.0, [](int tooth) { return 1.0 + 2.5 * (tooth - 1) / 29.0; }));
    ASSERT_TRUE(grows.has_value());
    EXPECT_TRUE(grows->grows);
    EXPECT_LT(grows->p_value, 1e-6);
    EXPECT_EQ(grows->last, 30);
    EXPECT_NEAR(grows->times, 3.5, 1.2);
    const auto run = loop::rougher_members(
        scatters(seed, 30, 60.0, [](int tooth) { return tooth >= 8 && tooth <= 12 ? 3.0 : 1.0; }));
    ASSERT_TRUE(run.has_value());
    EXPECT_FALSE(run->grows);
    EXPECT_EQ(run->first, 8);
    EXPECT_EQ(run->last, 12);
    EXPECT_NEAR(run->times, 3.0, 0.7);
    EXPECT_LT(run->p_value, 1e-6);
  }
}

TEST(RougherMembers, AreSeldomFoundWhereLoudnessDiffersByChance) {
  constexpr unsigned kRuns = 400;
  constexpr double kLevel = 0.01;
  int alarms = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(1000 + seed);
    std::normal_distribution<double> log(0.0, 0.5);
    const auto found = loop::rougher_members(scatters(seed, 8 + static_cast<int>(seed % 40), 50.0,
                                                      [&](int) { return std::exp(log(random)); }));
    alarms += found && found->p_value < kLevel ? 1 : 0;
  }
  EXPECT_LE(alarms, 12);  // 4 of 400 at the level; more than 12 once in 2000 runs
}

/// The upper of the two in the middle.
double middle_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// A member as the header says it: the mean logarithm over its courses, each less the median of its
/// set.
struct KnownMember {
  int number = 0;
  double log = 0.0, by_chance = 0.0;
};
std::vector<KnownMember> members_by_hand(const std::vector<loop::MemberScatter>& all, int set,
                                         double& usual) {
  std::map<int, std::vector<double>> logs_of_set, logs, chances;
  const auto counts = [&](const loop::MemberScatter& one) {
    return one.scatter > 0.0 && one.values > 0.0 && (set == -1 || set == one.set);
  };
  for (const loop::MemberScatter& one : all)
    if (counts(one)) logs_of_set[one.set].push_back(std::log(one.scatter));
  usual = 1.0;
  for (const auto& [of, values] : logs_of_set)
    usual *= std::pow(std::exp(middle_of(values)), 1.0 / static_cast<double>(logs_of_set.size()));
  for (const loop::MemberScatter& one : all) {
    if (!counts(one)) continue;
    logs[one.number].push_back(std::log(one.scatter) - middle_of(logs_of_set[one.set]));
    chances[one.number].push_back(2.5 / one.values);
  }
  std::vector<KnownMember> members;
  for (const auto& [number, own] : logs) {
    const auto n = static_cast<double>(own.size());
    KnownMember& member = members.emplace_back();
    member.number = number;
    for (const double log : own) member.log += log / n;
    for (const double chance : chances[number]) member.by_chance += chance / (n * n);
  }
  return members;
}

/// Of lines and runs of either set and of both the surest, each asked by itself.
std::optional<loop::RougherMembers> rougher_by_hand(const std::vector<loop::MemberScatter>& all) {
  std::optional<loop::RougherMembers> surest;
  int sets = 0;
  const auto take = [&](const loop::RougherMembers& one) {
    if (one.times >= 2.0 && (!surest || one.p_value < surest->p_value)) surest = one;
  };
  for (const int set : {-1, 0, 1}) {
    double usual = 0.0;
    const std::vector<KnownMember> members = members_by_hand(all, set, usual);
    const auto count = static_cast<int>(members.size());
    if (count < 8) continue;
    ++sets;
    const double n = count;
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, chance = 0.0;
    for (const KnownMember& one : members) {
      x += one.number / n;
      y += one.log / n;
      chance += one.by_chance / n;
    }
    for (const KnownMember& one : members) {
      xx += std::pow(one.number - x, 2);
      xy += (one.number - x) * (one.log - y);
      yy += std::pow(one.log - y, 2);
    }
    const double slope = xy / xx, left = std::max((yy - slope * xy) / (n - 2.0), chance);
    const int low = members.front().number, high = members.back().number;
    const int loudest = slope > 0.0 ? high : low;
    take({.set = set,
          .grows = true,
          .first = low + high - loudest,
          .last = loudest,
          .times = std::exp(std::abs(slope) * (high - low)),
          .inside = usual * std::exp(y + slope * (loudest - x)),
          .p_value = loop::student_two_sided(slope * std::sqrt(xx / left), n - 2.0)});
    loop::RougherMembers best_run;
    int runs = 0;
    for (int first = 0; first < count; ++first)
      for (int length = 2; length <= count / 3; ++length) {
        ++runs;
        double in = 0.0, out = 0.0, squares = 0.0;
        const auto is_in = [&](int i) { return (i - first + count) % count < length; };
        for (int i = 0; i < count; ++i)
          (is_in(i) ? in : out) +=
              members[static_cast<std::size_t>(i)].log / (is_in(i) ? length : count - length);
        for (int i = 0; i < count; ++i)
          squares += std::pow(members[static_cast<std::size_t>(i)].log - (is_in(i) ? in : out), 2);
        if (in - out < std::log(2.0)) continue;
        const double variance = std::max(squares / (n - 2.0), chance);
        const double t = (in - out) / std::sqrt(variance / length + variance / (n - length));
        const double p = 0.5 * loop::student_two_sided(t, n - 2.0);
        if (p >= best_run.p_value) continue;
        best_run = {.set = set,
                    .first = members[static_cast<std::size_t>(first)].number,
                    .last = members[static_cast<std::size_t>((first + length - 1) % count)].number,
                    .times = std::exp(in - out),
                    .inside = usual * std::exp(in),
                    .p_value = p};
      }
    best_run.p_value = std::min(1.0, runs * best_run.p_value);
    take(best_run);
  }
  if (surest) surest->p_value = std::min(1.0, 2.0 * sets * surest->p_value);
  return surest;
}

TEST(RougherMembers, AreTheSurestOfAllLinesAndRuns) {
  std::map<int, int> told_of;  // sets
  int grow = 0, runs = 0, none = 0, doubtful = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const int teeth = 7 + static_cast<int>(seed % 19), first = static_cast<int>(seed * 5 % 23);
    const int of_set = static_cast<int>(seed % 4) - 1;  // 2: none
    const double much = 0.2 + 1.6 * any(random), spread = seed % 5 == 0 ? 0.05 : 0.4;
    std::vector<loop::MemberScatter> all;
    for (int tooth = 1; tooth <= teeth; ++tooth)
      for (const int set : {0, 1}) {
        if (any(random) < 0.1 || (seed % 11 == 3 && set == 1)) continue;  // was not measured
        double log = spread * normal(random) + 0.7 * set;
        if (of_set == set || of_set == -1)
          log += seed % 2 == 0 ? much * (seed % 3 == 0 ? -tooth : tooth) / teeth * 2.0
                               : ((tooth + first) % teeth < 4 ? much : 0.0);
        all.push_back({3 + tooth, set, any(random) < 0.05 ? 0.0 : std::exp(log),
                       any(random) < 0.05 ? 0.0 : 20.0 + 60.0 * any(random)});
      }
    const auto told = loop::rougher_members(all), known = rougher_by_hand(all);
    double usual = 0.0;
    EXPECT_EQ(loop::are_asked(all), members_by_hand(all, -1, usual).size() >= 8) << seed;
    ASSERT_EQ(told.has_value(), known.has_value()) << seed;
    none += told ? 0 : 1;
    if (!told) continue;
    ++told_of[told->set];
    (told->grows ? grow : runs) += 1;
    doubtful += told->p_value == 1.0 ? 1 : 0;
    EXPECT_EQ(told->set, known->set) << seed;
    EXPECT_EQ(told->grows, known->grows) << seed;
    EXPECT_EQ(told->first, known->first) << seed;
    EXPECT_EQ(told->last, known->last) << seed;
    EXPECT_NEAR(told->times, known->times, 1e-9 * known->times) << seed;
    EXPECT_NEAR(told->inside, known->inside, 1e-9 * known->inside) << seed;
    EXPECT_NEAR(told->p_value, known->p_value, 1e-9 * known->p_value) << seed;
  }
  for (const int set : {-1, 0, 1}) EXPECT_GT(told_of[set], 10) << set;
  EXPECT_GT(std::min(grow, runs), 20);
  EXPECT_GT(std::min(none, doubtful), 1);
}

// What one flank alone was asked about is told of no flank: the words then are those of all.
TEST(RougherMembers, OfOneSetAloneAreToldOfAll) {
  for (const int only : {0, 1}) {
    std::vector<loop::MemberScatter> all =
        scatters(3, 30, 60.0, [](int tooth) { return tooth >= 8 && tooth <= 12 ? 3.0 : 1.0; });
    std::erase_if(all, [&](const loop::MemberScatter& one) { return one.set != only; });
    const auto run = loop::rougher_members(all);
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->set, -1);
  }
}

}  // namespace
}  // namespace trueflank::test
