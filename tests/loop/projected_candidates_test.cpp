// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/projected_candidates.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "tests/loop/discovery_problems.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Traces of fifteen values in two or three units each, with zeros of their own, and a model whose
/// third column is the sum of the first two.
DiscoveryProblem problem_of_traces() {
  DiscoveryProblem problem = test::made_problem(11, false, 5);
  problem.nuisance.col(2) = problem.nuisance.col(0) + problem.nuisance.col(1);
  for (int i = 0; i < 120; ++i) {
    const auto at = static_cast<std::size_t>(i);
    problem.zero[at] = i / 15;
    problem.whole.push_back(i / 15);
    problem.unit[at] = 3 * (i / 15) + i % (2 + (i / 15) % 2);
  }
  return problem;
}

/// Values by values: what the columns leave of candidates and value, and orthonormal ones for them.
struct ByHand {
  ByHand(const DiscoveryProblem& of, const BlockStatistics& statistics, const std::vector<int>& columns)
      : problem(of), used(statistics.used()) {
    const Eigen::VectorXd root = problem.weight(used).cwiseSqrt();
    candidates = root.asDiagonal() * statistics.candidates()(used, Eigen::all).cast<double>();
    value = root.cwiseProduct(statistics.value()(used));
    if (columns.empty()) {
      fitted.resize(value.size(), 0);
      return;
    }
    fitted = orthonormal_columns(root.asDiagonal() * statistics.model()(used, columns));
    candidates -= fitted * (fitted.transpose() * candidates);
    value -= fitted * (fitted.transpose() * value);
  }
  template <class Number>
  [[nodiscard]] std::vector<Eigen::Index> rows_where(const std::vector<int>& of, Number number) const {
    std::vector<Eigen::Index> rows;
    for (std::size_t r = 0; r < used.size(); ++r)
      if (of[static_cast<std::size_t>(used[r])] == number) rows.push_back(static_cast<Eigen::Index>(r));
    return rows;
  }
  [[nodiscard]] Eigen::MatrixXd lost(const CandidateGroup& group, int units) const {
    const Eigen::MatrixXd own = candidates.middleCols(group.first_column, group.columns);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(group.columns, group.columns);
    for (int unit = 0; unit < units; ++unit) {
      const auto rows = rows_where(problem.unit, unit);
      const Eigen::MatrixXd products = fitted(rows, Eigen::all).transpose() * own(rows, Eigen::all);
      sum += products.transpose() * products;
    }
    return sum;
  }

  const DiscoveryProblem& problem;
  std::vector<int> used;
  Eigen::MatrixXd candidates, fitted;
  Eigen::VectorXd value;
};

void expect_as_by_hand(const ProjectedCandidates& beside, const DiscoveryProblem& problem,
                       const BlockStatistics& statistics, const std::vector<int>& independent) {
  constexpr double kSame = 1e-9;
  const ByHand hand(problem, statistics, independent);
  const Eigen::VectorXd scores = hand.candidates.transpose() * hand.value;
  EXPECT_LT((beside.scores() - scores).cwiseAbs().maxCoeff(), kSame);
  for (int unit = 0; unit < statistics.units(); ++unit) {
    const auto rows = hand.rows_where(problem.unit, unit);
    const Eigen::VectorXd own = hand.candidates(rows, Eigen::all).transpose() * hand.value(rows);
    for (int g = 0; g < 12; ++g)  // the others are local
      for (int k = 0; k < problem.groups[g].columns; ++k)
        EXPECT_NEAR(beside.unit_scores()(problem.groups[g].first_column + k, unit),
                    own[problem.groups[g].first_column + k], kSame);
  }
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const CandidateGroup& group = problem.groups[g];
    const Eigen::MatrixXd own = hand.candidates.middleCols(group.first_column, group.columns);
    EXPECT_LT((beside.gram(static_cast<int>(g)) - own.transpose() * own).cwiseAbs().maxCoeff(), 1e-5) << g;
    if (group.local_family < 0) {
      EXPECT_LT((beside.lost_by_flips(static_cast<int>(g)) - hand.lost(group, statistics.units()))
                    .cwiseAbs()
                    .maxCoeff(),
                kSame)
          << g;
    }
  }
  const std::vector<PanelColumns>& panels = statistics.panels();
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (!beside.is_asked(p)) continue;
    for (int whole = 0; whole < 8; ++whole) {
      const auto rows = hand.rows_where(problem.whole, whole);
      const Eigen::MatrixXd own =
          hand.candidates(rows, Eigen::all).middleCols(panels[p].first_column, panels[p].columns);
      const PanelRow* const products = beside.products_of_whole(p, static_cast<std::size_t>(whole));
      for (int apart = 0; apart < 3; ++apart)
        for (int j = 0; j + apart < panels[p].columns; ++j)
          EXPECT_NEAR(products[apart][static_cast<std::size_t>(j)], own.col(j).dot(own.col(j + apart)),
                      1e-5);
    }
  }
}

TEST(ProjectedCandidates, AreWhatColumnsLeaveOfEveryUnitAndWhole) {
  const DiscoveryProblem problem = problem_of_traces();
  BlockStatistics statistics(problem);
  const int first = statistics.add_group(2), other = statistics.add_group(7);
  ProjectedCandidates beside(problem, statistics, {});
  std::vector<int> columns, independent;
  expect_as_by_hand(beside, problem, statistics, independent);
  for (const int column : {0, 1, 2, 3, first, first + 1, first + 2}) {
    columns.push_back(column);
    if (column != 2) independent.push_back(column);  // which is told by the first two
    beside.put_beside(columns);
    EXPECT_EQ(beside.fitted(), columns.size());
    expect_as_by_hand(beside, problem, statistics, independent);
  }
  // others, and fewer
  beside.put_beside({4, other, 0});
  expect_as_by_hand(beside, problem, statistics, {4, other, 0});
  beside.put_beside({4});
  expect_as_by_hand(beside, problem, statistics, {4});
}

TEST(ProjectedCandidates, OfPanelsThatNobodyAsksAboutKeepScoresAndGrams) {
  DiscoveryProblem problem = problem_of_traces();
  const BlockStatistics statistics(problem);
  std::vector<bool> banned(problem.groups.size(), true);
  ProjectedCandidates all(problem, statistics, {}), none(problem, statistics, banned);
  for (ProjectedCandidates* beside : {&all, &none}) beside->put_beside({0, 3, 4});
  for (std::size_t p = 0; p < statistics.panels().size(); ++p) EXPECT_FALSE(none.is_asked(p));
  EXPECT_LT((all.scores() - none.scores()).cwiseAbs().maxCoeff(), 1e-9);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    EXPECT_LT((all.gram(g) - none.gram(g)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace trueflank::loop
