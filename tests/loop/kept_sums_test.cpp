// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/kept_sums.h"

#include <gtest/gtest.h>

#include "discovery_problems.h"
#include "trueflank/loop/discovery/block_statistics.h"

namespace trueflank::loop {
namespace {

using test::made_problem;

/// The same numbers, digit by digit, as of sums made anew; model columns are added in this order.
void expect_as_made_anew(const DiscoveryProblem& problem, const BlockStatistics& sums,
                         const std::vector<int>& added) {
  BlockStatistics anew(problem);
  for (const int group : added) (void)anew.add_group(group);
  const auto expect_same = [](const BlockStatistics::Sums& a, const BlockStatistics::Sums& b) {
    EXPECT_EQ(a.value_value, b.value_value);
    EXPECT_EQ(a.weight, b.weight);
    EXPECT_EQ(a.candidate_value, b.candidate_value);
    EXPECT_EQ(a.model_value, b.model_value);
    EXPECT_EQ(a.model_model, b.model_model);
    EXPECT_EQ(a.model_candidate, b.model_candidate);
  };
  EXPECT_EQ(sums.candidates(), anew.candidates());
  EXPECT_EQ(sums.model(), anew.model());
  expect_same(sums.all(), anew.all());
  for (int fold = 1; fold <= anew.folds(); ++fold) expect_same(sums.fold(fold), anew.fold(fold));
  for (int unit = 0; unit < anew.units(); ++unit) expect_same(sums.unit(unit), anew.unit(unit));
  for (int column = 0; column < anew.model_columns(); ++column)
    for (std::size_t p = 0; p < anew.panels().size(); ++p)
      for (int unit = 0; unit < anew.units(); ++unit)
        EXPECT_EQ(sums.unit_candidates(column, p, unit), anew.unit_candidates(column, p, unit))
            << column << " " << p << " " << unit;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    for (int fold = 0; fold <= anew.folds(); ++fold)
      EXPECT_EQ(sums.group_gram(g, fold), anew.group_gram(g, fold));
    EXPECT_EQ(sums.zero_loss(g), anew.zero_loss(g));
  }
  ASSERT_EQ(sums.wholes().size(), anew.wholes().size());
  for (const auto& [number, whole] : anew.wholes()) {
    EXPECT_EQ(sums.wholes().at(number).units, whole.units);
    ASSERT_EQ(sums.wholes().at(number).products.size(), whole.products.size());
    // products of columns of two groups are asked by nobody
    const auto columns = static_cast<std::size_t>(problem.candidates.cols());
    for (const CandidateGroup& group : problem.groups)
      for (int a = 0; a < group.columns; ++a)
        for (int b = a; b < group.columns; ++b) {
          const std::size_t at = static_cast<std::size_t>(b - a) * columns +
                                 static_cast<std::size_t>(group.first_column + a);
          EXPECT_EQ(sums.wholes().at(number).products[at], whole.products[at]);
        }
  }
}

/// Wide enough for several panels, and with whole traces.
DiscoveryProblem wide_problem(bool zeros) {
  DiscoveryProblem problem = made_problem(3, zeros);
  const CandidateMatrix once = problem.candidates;
  const std::vector<CandidateGroup> groups = problem.groups;
  for (int times = 1; times < 4; ++times) {
    const auto first = static_cast<int>(problem.candidates.cols());
    problem.candidates.conservativeResize(Eigen::NoChange, first + once.cols());
    problem.candidates.rightCols(once.cols()) =
        once.array().pow(static_cast<float>(times + 1)).matrix();
    for (CandidateGroup group : groups) {
      group.first_column += first;
      group.local_family = -1;
      problem.groups.push_back(group);
    }
  }
  problem.whole = problem.unit;
  return problem;
}

void move_group(DiscoveryProblem& problem, KeptSums& kept, std::size_t g) {
  const CandidateGroup& group = problem.groups[g];
  problem.candidates.middleCols(group.first_column, group.columns).array() += 0.25f;
  problem.candidates.row(5).segment(group.first_column, group.columns).array() *= 3.0f;
  kept.forget(g);
}

TEST(KeptSums, AreThoseMadeAnewWhateverMoved) {
  for (const bool zeros : {false, true}) {
    DiscoveryProblem problem = wide_problem(zeros);
    KeptSums kept;
    const auto choose = [&](const std::vector<int>& added) {
      auto sums = kept.taken_for(problem);
      for (const int group : added) (void)sums->add_group(group);
      expect_as_made_anew(problem, *sums, added);
      kept.give_back(std::move(sums));
    };
    choose({40, 4, 9});
    choose({40, 4, 9});  // nothing moved
    move_group(problem, kept, 9);
    move_group(problem, kept, 77);
    choose({4, 9, 30, 40});  // one of the model and one beside it
    choose({30});
    move_group(problem, kept, 61);
    choose({9, 40, 30});  // two were not asked for when a group moved
  }
}

TEST(KeptSums, OfOtherRowsOrNuisanceAreMadeAnew) {
  DiscoveryProblem problem = wide_problem(true);
  KeptSums kept;
  const auto choose = [&] {
    auto sums = kept.taken_for(problem);
    (void)sums->add_group(4);
    expect_as_made_anew(problem, *sums, {4});
    kept.give_back(std::move(sums));
  };
  choose();
  const double weight = problem.weight[7];
  problem.weight[7] *= 1e-6;
  choose();
  move_group(problem, kept, 4);
  choose();
  problem.weight[7] = weight;  // as first, but for the group that moved since
  choose();
  problem.value[3] += 1.0;
  choose();
  problem.nuisance.col(1).array() *= 0.5;
  choose();
  problem.nuisance.conservativeResize(Eigen::NoChange, 1);
  choose();
  std::swap(problem.fold[1], problem.fold[2]);
  choose();
  problem.zero[8] = -1;
  choose();
}

TEST(KeptSums, GoOnWhereCandidatesAreAddedOrTakenAway) {
  DiscoveryProblem problem = wide_problem(true);
  const DiscoveryProblem whole = problem;
  KeptSums kept;
  const auto choose_of = [&](std::size_t groups) {
    problem.groups.assign(whole.groups.begin(),
                          whole.groups.begin() + static_cast<std::ptrdiff_t>(groups));
    problem.candidates = whole.candidates.leftCols(problem.groups.back().first_column +
                                                   problem.groups.back().columns);
    auto sums = kept.taken_for(problem);
    for (const int group : {4, 30}) (void)sums->add_group(group);
    expect_as_made_anew(problem, *sums, {4, 30});
    kept.give_back(std::move(sums));
  };
  choose_of(40);
  choose_of(whole.groups.size());
  choose_of(62);
  kept.forget(62);
  choose_of(63);
}

TEST(KeptSums, ChoicesFromThemAreThoseWithoutThem) {
  DiscoveryProblem problem = test::holding({{4, 0.8}, {8, 0.6}, {1, 1.0}});
  problem.kept = std::make_shared<KeptSums>();
  for (int round = 0; round < 3; ++round) {
    if (round > 0) {
      move_group(problem, *problem.kept, 8);
      move_group(problem, *problem.kept, 2);
    }
    DiscoveryProblem alone = problem;
    alone.kept = nullptr;
    const DiscoveryResult with = discover(problem, {}), without = discover(alone, {});
    ASSERT_EQ(with.chosen.size(), without.chosen.size());
    EXPECT_FALSE(with.chosen.empty());
    EXPECT_EQ(with.p_left, without.p_left);
    for (std::size_t i = 0; i < with.chosen.size(); ++i) {
      EXPECT_EQ(with.chosen[i].group, without.chosen[i].group);
      EXPECT_EQ(with.chosen[i].gain, without.chosen[i].gain);
      EXPECT_EQ(with.chosen[i].bic_gain, without.chosen[i].bic_gain);
      EXPECT_EQ(with.chosen[i].confounded, without.chosen[i].confounded);
    }
  }
}

}  // namespace
}  // namespace trueflank::loop
