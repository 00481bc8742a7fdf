// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/discovery.h"
#include "trueflank/loop/discovery/structure_test.h"

// Small made problems for the engine.
namespace trueflank::loop::test {

/// Groups of one to three columns, the last twelve local ones, over values in eight units, four
/// folds and, where wanted, six traces with zeros of their own.
inline DiscoveryProblem made_problem(unsigned seed, bool zeros, int nuisance = 2) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  constexpr int kValues = 120, kGroups = 24, kCommon = 12;
  DiscoveryProblem problem;
  for (int g = 0, column = 0; g < kGroups; ++g) {
    const int columns = g < kCommon ? 1 + g % 3 : 1;
    problem.groups.push_back(
        {.first_column = column, .columns = columns, .local_family = g < kCommon ? -1 : 0});
    column += columns;
  }
  const auto columns = problem.groups.back().first_column + 1;
  problem.value = Eigen::VectorXd::NullaryExpr(kValues, [&] { return normal(random); });
  problem.weight =
      Eigen::VectorXd::NullaryExpr(kValues, [&] { return 0.5 + std::abs(normal(random)); });
  problem.nuisance =
      Eigen::MatrixXd::NullaryExpr(kValues, nuisance, [&] { return normal(random); });
  problem.candidates = Eigen::MatrixXf::NullaryExpr(
      kValues, columns, [&] { return static_cast<float>(normal(random)); });
  for (int i = 0; i < kValues; ++i) {
    problem.unit.push_back((i / 3) % 8);
    problem.fold.push_back(i % 5);  // 0 is locked
    problem.zero.push_back(zeros && i % 7 > 0 ? i % 7 - 1 : -1);
  }
  return problem;
}

/// Values that hold some groups, each column with this factor, and a little noise.
inline DiscoveryProblem holding(const std::vector<std::pair<int, double>>& groups,
                                unsigned seed = 7) {
  DiscoveryProblem problem = made_problem(seed, false);
  for (int i = 0; i < 120; ++i) problem.unit[static_cast<std::size_t>(i)] = i / 3;
  for (const auto& [g, factor] : groups)
    for (int k = 0; k < problem.groups[g].columns; ++k)
      problem.value +=
          factor * problem.candidates.col(problem.groups[g].first_column + k).cast<double>();
  return problem;
}

/// What is told beside some columns of a model, all at once.
inline StructureTest structure_beside(const DiscoveryProblem& problem,
                                      const BlockStatistics& statistics,
                                      const std::vector<int>& columns, int flips,
                                      const std::vector<bool>& banned = {}) {
  ProjectedCandidates beside(problem, statistics, banned);
  beside.put_beside(columns);
  return {problem, statistics, beside, flips, banned};
}

}  // namespace trueflank::loop::test
