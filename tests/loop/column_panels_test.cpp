// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/column_panels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/agreement.h"
#include "trueflank/loop/discovery/cross_validation.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/quick_errors.h"

namespace trueflank::loop {
namespace {

/// Groups of one, two and three columns, some of them local, over values in six units and four
/// folds.
DiscoveryProblem random_problem(int seed) {
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  std::normal_distribution<double> normal;
  constexpr int kValues = 90, kModel = 5, kGroups = 40;
  DiscoveryProblem problem;
  for (int g = 0, column = 0; g < kGroups; ++g) {
    CandidateGroup group;
    group.first_column = column;
    group.columns = 1 + g % 3;
    group.local_family = g > 20 && g < 25 ? 0 : -1;
    column += group.columns;
    problem.groups.push_back(group);
  }
  const auto columns = problem.groups.back().first_column + problem.groups.back().columns;
  problem.value = Eigen::VectorXd::NullaryExpr(kValues, [&] { return normal(random); });
  problem.weight =
      Eigen::VectorXd::NullaryExpr(kValues, [&] { return 0.5 + std::abs(normal(random)); });
  problem.nuisance = Eigen::MatrixXd::NullaryExpr(kValues, kModel, [&] { return normal(random); });
  problem.candidates = Eigen::MatrixXf::NullaryExpr(
      kValues, columns, [&] { return static_cast<float>(normal(random)); });
  for (int i = 0; i < kValues; ++i) {
    problem.unit.push_back(i % 6);
    problem.fold.push_back(i % 5);  // 0 is locked
    problem.zero.push_back(-1);
  }
  return problem;
}

TEST(ColumnPanels, HoldWholeGroupsAndNoLocalOnesBesideOthers) {
  const DiscoveryProblem problem = random_problem(1);
  int next = 0;
  for (const PanelColumns& panel : panels_of(problem.groups)) {
    EXPECT_EQ(panel.first_group, next);
    EXPECT_LE(panel.columns, kPanelColumns);
    int columns = 0;
    for (int g = next; g < next + panel.groups; ++g) {
      EXPECT_EQ(problem.groups[g].local_family, problem.groups[next].local_family);
      columns += problem.groups[g].columns;
    }
    EXPECT_EQ(panel.columns, columns);
    next += panel.groups;
    if (next == static_cast<int>(problem.groups.size())) break;
    // the next one does not fit, or is of the other kind
    EXPECT_TRUE(columns + problem.groups[next].columns > static_cast<int>(kPanelColumns) ||
                problem.groups[next].local_family != problem.groups[next - 1].local_family)
        << next;
  }
  EXPECT_EQ(next, static_cast<int>(problem.groups.size()));
}

TEST(ColumnPanels, AreSolvedAsOneColumnAfterTheOther) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto any = [&] { return normal(random); };
  constexpr Eigen::Index kSize = 9;
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(kSize, kSize, any);
  const SymmetricSolver symmetric(root * root.transpose());
  const Eigen::MatrixXd right = Eigen::MatrixXd::NullaryExpr(kSize, kPanelColumns, any);
  const PanelSolver solver(symmetric);
  Panel panel(kSize);
  for (std::size_t k = 0; k < kSize; ++k)
    for (std::size_t j = 0; j < kPanelColumns; ++j)
      panel[k][j] =
          right(static_cast<Eigen::Index>(solver.row_at(k)), static_cast<Eigen::Index>(j));
  solver.solve_lower(panel);
  solver.solve_upper(panel);
  const Eigen::MatrixXd expected = symmetric.solve_columns(right);
  for (std::size_t k = 0; k < kSize; ++k)
    for (std::size_t j = 0; j < kPanelColumns; ++j)
      EXPECT_NEAR(
          panel[k][j],
          expected(static_cast<Eigen::Index>(solver.row_at(k)), static_cast<Eigen::Index>(j)),
          1e-9 * expected.norm());
}

/// Fitted to the values of the other folds, asked on one: without sums of any kind.
double error_by_hand(const DiscoveryProblem& problem, const CandidateGroup& group, int fold) {
  std::vector<Eigen::Index> learnt, asked;
  for (Eigen::Index i = 0; i < problem.value.size(); ++i) {
    const int own = problem.fold[static_cast<std::size_t>(i)];
    if (own > 0) (own == fold ? asked : learnt).push_back(i);
  }
  Eigen::MatrixXd columns(problem.value.size(), problem.nuisance.cols() + group.columns);
  columns << problem.nuisance,
      problem.candidates.middleCols(group.first_column, group.columns).cast<double>();
  const Eigen::VectorXd root = problem.weight.cwiseSqrt();
  const Eigen::MatrixXd weighted = root.asDiagonal() * columns;
  const Eigen::VectorXd values = root.cwiseProduct(problem.value);
  const Eigen::VectorXd b =
      least_squares(weighted(learnt, Eigen::all), values(learnt));
  return (values(asked) - weighted(asked, Eigen::all) * b).squaredNorm();
}

TEST(CrossValidation, OfAGroupMoreIsAFitToTheOtherFolds) {
  const DiscoveryProblem problem = random_problem(2);
  const BlockStatistics statistics(problem);
  const CrossValidation model(problem, statistics, {0, 1, 2, 3, 4});
  std::vector<int> groups;
  for (int g = 39; g >= 0; g -= 2) groups.push_back(g);  // in any order
  const std::vector<FoldErrors> errors = model.errors_with(groups);
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (int fold = 1; fold <= 4; ++fold)
      EXPECT_NEAR(errors[i][fold - 1], error_by_hand(problem, problem.groups[groups[i]], fold),
                  2e-4)
          << "group " << groups[i] << ", fold " << fold;
}

/// The model's columns but for those at some places.
std::vector<int> others(const std::vector<int>& columns, const std::vector<Eigen::Index>& places) {
  std::vector<int> left;
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (std::find(places.begin(), places.end(), static_cast<Eigen::Index>(k)) == places.end())
      left.push_back(columns[k]);
  return left;
}

TEST(QuickErrors, AreThoseOfCrossValidationButForRounding) {
  const DiscoveryProblem problem = random_problem(5);
  BlockStatistics statistics(problem);
  std::vector<int> columns{0, 1, 2, 3, 4};
  for (const int group : {2, 9, 4}) {  // of three, one and two columns
    const int first = statistics.add_group(group);
    for (int k = 0; k < problem.groups[group].columns; ++k) columns.push_back(first + k);
  }
  const std::vector<int> groups{0, 1, 5, 14, 39, 30};
  const QuickErrors quick(problem, statistics, columns, {30, 14, 0, 1, 39, 38, 5});
  ASSERT_TRUE(quick.are_reliable());
  using Places = std::vector<Eigen::Index>;
  for (const Places& places : {Places{8}, Places{5, 6, 7}, Places{8, 9, 10}, Places{0, 3, 5, 10}}) {
    const QuickErrors::Less less = quick.errors_less(places, groups);
    const CrossValidation exact(problem, statistics, others(columns, places));
    EXPECT_LT((less.base - exact.base_errors()).cwiseAbs().maxCoeff(), 0.1 * quick.rounding());
    const std::vector<FoldErrors> with = exact.errors_with(groups);
    for (std::size_t i = 0; i < groups.size(); ++i)
      EXPECT_LT((less.with[i] - with[i]).cwiseAbs().maxCoeff(), 0.1 * quick.rounding())
          << "group " << groups[i] << " less " << places.size();
  }
}

TEST(QuickErrors, AreNotAskedWhereAFoldHardlyTellsColumnsApart) {
  DiscoveryProblem problem = random_problem(6);
  for (int i = 0; i < 90; ++i)  // only the third fold says how the first two columns differ
    if (problem.fold[static_cast<std::size_t>(i)] != 3)
      problem.nuisance(i, 1) = problem.nuisance(i, 0) * (1.0 + 1e-5 * (i % 2));
  const BlockStatistics statistics(problem);
  EXPECT_FALSE(QuickErrors(problem, statistics, {0, 1, 2}, {0, 1}).are_reliable());
  EXPECT_TRUE(QuickErrors(problem, statistics, {0, 2, 3}, {0, 1}).are_reliable());
}

/// Fifteen wholes of six values each, cut into so many units; one value of each whole is locked.
DiscoveryProblem problem_of_wholes(int units_of_a_whole) {
  DiscoveryProblem problem = random_problem(3);
  for (int i = 0; i < static_cast<int>(problem.value.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    problem.whole.push_back(i % 15);
    problem.unit[at] = (i % 15) * units_of_a_whole + (i / 15) % units_of_a_whole;
    problem.fold[at] = (i / 15) % 5;
  }
  return problem;
}

/// A problem seen from the values that are not locked, by sums over each of them.
struct SeenByHand {
  explicit SeenByHand(const DiscoveryProblem& of) : problem(of), statistics(of) {
    const std::vector<int>& used = statistics.used();
    const Eigen::MatrixXd f = problem.nuisance(used, Eigen::all);
    const Eigen::MatrixXd c = problem.candidates(used, Eigen::all).cast<double>();
    const Eigen::VectorXd w = problem.weight(used), y = problem.value(used);
    const Eigen::MatrixXd weighted = w.asDiagonal() * f;
    const SquareSolver normal(f.transpose() * weighted);
    const Eigen::MatrixXd absorbed = normal.solve_columns(weighted.transpose() * c);
    const Eigen::VectorXd fitted = normal.solve_columns(weighted.transpose() * y);
    beside = c - f * absorbed;
    left = y - f * fitted;
    weight = w;
    for (const CandidateGroup& group : problem.groups) {
      const auto own = beside.middleCols(group.first_column, group.columns);
      projected.emplace_back(own.transpose() * w.asDiagonal() * own);
    }
  }
  [[nodiscard]] std::vector<double> agreement() const {
    std::vector<int> columns(static_cast<std::size_t>(problem.nuisance.cols()));
    std::iota(columns.begin(), columns.end(), 0);
    ProjectedCandidates candidates(problem, statistics, {});
    candidates.put_beside(columns);
    return agreement_of_wholes(problem, statistics, candidates, projected,
                               std::vector<bool>(problem.groups.size(), true));
  }

  const DiscoveryProblem& problem;
  BlockStatistics statistics;
  Eigen::MatrixXd beside;
  Eigen::VectorXd left, weight;
  std::vector<Eigen::MatrixXd> projected;
};

/// Traces whose errors hang together from one value to the next: mean square 1, `together` between neighbours.
DiscoveryProblem problem_of_chains(double together, unsigned seed) {
  constexpr int kTraces = 40, kOfTrace = 60;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  DiscoveryProblem problem;
  problem.groups.push_back({.first_column = 0, .columns = 1});
  problem.value.resize(kTraces * kOfTrace);
  problem.weight.setOnes(kTraces * kOfTrace);
  problem.nuisance.setOnes(kTraces * kOfTrace, 1);
  problem.candidates.setOnes(kTraces * kOfTrace, 1);
  for (int trace = 0, i = 0; trace < kTraces; ++trace)
    for (int k = 0; k < kOfTrace; ++k, ++i) {
      const double own = normal(random);
      problem.value[i] = k == 0 ? own : together * problem.value[i - 1] + std::sqrt(1.0 - together * together) * own;
      problem.candidates(i, 0) = static_cast<float>(normal(random));
      problem.unit.push_back(trace);
      problem.whole.push_back(trace);
      problem.zero.push_back(trace);
      problem.fold.push_back(1 + trace % 4);
    }
  return problem;
}

TEST(Agreement, ErrorsThatHangTogetherScatterAMeanMore) {
  // The mean of n values of such a chain has the variance (1 + rho) / (1 - rho) / n, for large n. Rho is seen beside
  // courses of nine figures and told in steps of 0.05, the next one up: at 0.6 each is a quarter of the variance.
  for (const double together : {0.0, 0.3, 0.6})
    for (unsigned seed = 1; seed <= 8; ++seed) {
      const DiscoveryProblem problem = problem_of_chains(together, seed);
      const double share = BlockStatistics(problem).scatter_within() * (1.0 - together) / (1.0 + together);
      EXPECT_GT(share, 0.75) << together << " " << seed;
      EXPECT_LT(share, 2.25) << together << " " << seed;
    }
}

TEST(Agreement, OfWholesIsAnFTestOfWhatEachSaysByItself) {
  const DiscoveryProblem problem = problem_of_wholes(1);
  const SeenByHand seen(problem);
  const std::vector<double> p = seen.agreement();
  ASSERT_EQ(p.size(), problem.groups.size());
  for (std::size_t g = 0; g < 20; g += 3) {  // of one column
    double gram = 0.0, score = 0.0, total = 0.0;
    for (int whole = 0; whole < 15; ++whole) {
      double own = 0.0, along = 0.0;
      for (std::size_t r = 0; r < seen.statistics.used().size(); ++r) {
        const auto row = static_cast<Eigen::Index>(r);
        if (seen.statistics.used()[r] % 15 != whole) continue;
        const double x = seen.beside(row, problem.groups[g].first_column);
        own += seen.weight[row] * x * x;
        along += seen.weight[row] * x * seen.left[row];
      }
      gram += own;
      score += along;
      total += along * along / own;
    }
    const double explained = score * score / gram;
    constexpr double kDegrees = 15.0 - 1.0 - 5.0;
    EXPECT_NEAR(p[g], f_tail(explained / ((total - explained) / kDegrees), 1.0, kDegrees), 1e-9)
        << "group " << g;
  }
}

/// X V and V of a matrix X = U S V': its columns turned against each other, two at a time, until all stand at right
/// angles (one-sided Jacobi; Eigen's own decomposition compiles for seconds).
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> turned_apart(Eigen::MatrixXd x) {
  Eigen::MatrixXd v = Eigen::MatrixXd::Identity(x.cols(), x.cols());
  const auto turn = [](Eigen::MatrixXd& m, Eigen::Index i, Eigen::Index k, double c, double s) {
    const Eigen::VectorXd before = m.col(i);
    m.col(i) = c * before - s * m.col(k);
    m.col(k) = s * before + c * m.col(k);
  };
  constexpr int kSweeps = 30;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      for (Eigen::Index k = i + 1; k < x.cols(); ++k) {
        const double mixed = x.col(i).dot(x.col(k));
        const double angle = 0.5 * std::atan2(2.0 * mixed, x.col(k).squaredNorm() - x.col(i).squaredNorm());
        turn(x, i, k, std::cos(angle), std::sin(angle));
        turn(v, i, k, std::cos(angle), std::sin(angle));
      }
  return {x, v};
}

TEST(Agreement, OfGroupsOfColumnsCountsTheDirectionsThatAWholeHolds) {
  const DiscoveryProblem problem = problem_of_wholes(1);
  const SeenByHand seen(problem);
  const std::vector<double> p = seen.agreement();
  int asked = 0;
  for (std::size_t g = 1; g < 21; ++g) {
    const int columns = problem.groups[g].columns;
    if (columns == 1) continue;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns, columns);
    Eigen::VectorXd score = Eigen::VectorXd::Zero(columns);
    double total = 0.0;
    int degrees = 0;
    for (int whole = 0; whole < 15; ++whole) {
      std::vector<Eigen::Index> rows;
      for (std::size_t r = 0; r < seen.statistics.used().size(); ++r)
        if (seen.statistics.used()[r] % 15 == whole) rows.push_back(static_cast<Eigen::Index>(r));
      const Eigen::VectorXd root = seen.weight(rows).cwiseSqrt();
      const Eigen::MatrixXd x =
          root.asDiagonal() *
          seen.beside(rows, Eigen::all).middleCols(problem.groups[g].first_column, columns);
      const Eigen::VectorXd y = root.cwiseProduct(seen.left(rows));
      const auto [turned, directions] = turned_apart(x);
      for (Eigen::Index k = 0; k < columns; ++k) {
        const double s = turned.col(k).norm(), along = turned.col(k).dot(y) / s;
        if (!(s * s > 1e-3 * seen.projected[g].trace() / 15.0)) continue;
        const Eigen::VectorXd direction = directions.col(k);
        gram += s * s * direction * direction.transpose();
        score += s * along * direction;
        total += along * along;
        ++degrees;
      }
    }
    const double explained = score.dot(symmetric_solution(gram, score));
    const double below = degrees - columns - 5.0;
    EXPECT_NEAR(p[g], f_tail(explained / columns / ((total - explained) / below), columns, below),
                1e-7)
        << g;
    ++asked;
  }
  EXPECT_GT(asked, 10);
}

// Columns of whole numbers at right angles and of one length in a whole: no direction of the two
// is the first.
TEST(Agreement, OfTwoColumnsAlikeInAWholeCountsBoth) {
  constexpr int kWholes = 12, kOfWhole = 4;
  DiscoveryProblem problem = random_problem(8);
  const int n = kWholes * kOfWhole;
  problem.groups = {{.first_column = 0, .columns = 2}};
  problem.value.conservativeResize(n);
  problem.weight.setOnes(n);
  problem.nuisance.setOnes(n, 1);
  problem.candidates.resize(n, 2);
  for (auto* numbers : {&problem.unit, &problem.fold, &problem.zero, &problem.whole})
    numbers->resize(n, -1);
  Eigen::Vector2d score = Eigen::Vector2d::Zero();
  const double mean = problem.value.mean();
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int whole = i / kOfWhole, k = i % kOfWhole, size = 1 + whole % 3;
    problem.unit[at] = problem.whole[at] = whole;
    problem.fold[at] = 1 + whole % 4;
    problem.candidates(i, 0) = static_cast<float>(k % 2 == 0 ? size : -size);
    problem.candidates(i, 1) = static_cast<float>(k < 2 ? size : -size);
  }
  // (in one of them the first is longer)
  problem.candidates.topRows(kOfWhole).col(0) *= 4.0f;
  Eigen::Vector2d gram = Eigen::Vector2d::Zero();
  double total = 0.0;
  for (int whole = 0; whole < kWholes; ++whole) {
    const Eigen::MatrixXd own =
        problem.candidates.middleRows(whole * kOfWhole, kOfWhole).cast<double>();
    const Eigen::Vector2d of_whole =
        own.transpose() *
        (problem.value.segment(whole * kOfWhole, kOfWhole).array() - mean).matrix();
    const Eigen::Vector2d squares = own.colwise().squaredNorm();
    score += of_whole;
    gram += squares;
    total += of_whole.cwiseAbs2().cwiseQuotient(squares).sum();
  }
  const double explained = score.cwiseAbs2().cwiseQuotient(gram).sum();
  constexpr double kBelow = 2.0 * kWholes - 2.0 - 1.0;
  const std::vector<double> p = SeenByHand(problem).agreement();
  ASSERT_EQ(p.size(), 1U);
  EXPECT_NEAR(p[0], f_tail(explained / 2.0 / ((total - explained) / kBelow), 2.0, kBelow), 1e-9);
}

TEST(Agreement, IsAskedOfFourToTwentyFourWholes) {
  // (with many fitted columns some values of a whole tell first)
  for (const auto& [wholes, fitted] :
       {std::pair{3, 5}, {4, 5}, {24, 5}, {25, 5}, {96, 5}, {97, 5}, {96, 12}, {40, 14}}) {
    DiscoveryProblem problem = random_problem(5);
    if (wholes > 30) {  // one value of each, and another of some
      const Eigen::Index n = 2 * wholes;
      std::mt19937 random(9);
      std::normal_distribution<double> normal;
      const auto any = [&] { return normal(random); };
      problem.value = Eigen::VectorXd::NullaryExpr(n, any);
      problem.weight = Eigen::VectorXd::Ones(n);
      problem.nuisance = Eigen::MatrixXd::NullaryExpr(n, fitted, any);
      problem.candidates = Eigen::MatrixXf::NullaryExpr(n, problem.candidates.cols(),
                                                        [&] { return static_cast<float>(any()); });
      // groups 0 and 3 live in the first 24 and 25 wholes
      for (Eigen::Index i = 0; i < n; ++i) {
        problem.candidates(i, 0) *= i % wholes < 24 ? 1.0f : 0.0f;
        problem.candidates(i, 6) *= i % wholes < 25 ? 1.0f : 0.0f;
      }
      problem.nuisance.setZero();
      problem.nuisance.topRows(fitted).setIdentity();
    }
    const auto n = static_cast<std::size_t>(problem.value.size());
    problem.unit.assign(n, 0);
    problem.fold.assign(n, 0);
    problem.zero.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i) {
      const int whole = static_cast<int>(i) % wholes;
      problem.whole.push_back(whole);
      problem.unit[i] = whole;
      problem.fold[i] = 1 + whole % 4;
    }
    const std::vector<double> p = SeenByHand(problem).agreement();
    EXPECT_EQ(p.empty(), wholes < 4 || wholes > 96) << wholes;
    if (p.empty()) continue;
    if (wholes < 10) {
      EXPECT_EQ(p[0], 1.0);  // 4 wholes less 5 fitted columns are none
    } else if (wholes < 30) {
      EXPECT_EQ(p[0] < 1.0, wholes == 24);
    } else {
      EXPECT_LT(p[0], 1.0);
      EXPECT_EQ(p[3], 1.0);
    }
  }
}

TEST(Agreement, OfWholesIsTheSameHoweverTheyAreCutIntoUnits) {
  const DiscoveryProblem whole = problem_of_wholes(1), cut = problem_of_wholes(2);
  const std::vector<double> p = SeenByHand(whole).agreement(), of_cut = SeenByHand(cut).agreement();
  ASSERT_EQ(p.size(), of_cut.size());
  int asked = 0;
  for (std::size_t g = 0; g < p.size(); ++g) {
    EXPECT_NEAR(p[g], of_cut[g], 1e-9) << "group " << g;
    asked += p[g] < 1.0 ? 1 : 0;
  }
  EXPECT_GT(asked, 30);
}

}  // namespace
}  // namespace trueflank::loop
