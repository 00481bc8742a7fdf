// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "tests/loop/discovery_problems.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/block_statistics.h"
#include "trueflank/loop/discovery/column_panels.h"
#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/discovery.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/ring_scan.h"
#include "trueflank/loop/discovery/structure_test.h"

// The engine's figures, computed again value by value on small made problems.
namespace trueflank::loop {
namespace {

using test::holding;
using test::made_problem;

/// The used values, each trace less its own weighted mean.
struct CentredByHand {
  std::vector<int> used;
  Eigen::VectorXd weight, value;
  Eigen::MatrixXd model, candidates;

  explicit CentredByHand(const DiscoveryProblem& p)
      : weight(p.weight),
        value(p.value),
        model(p.nuisance),
        candidates(p.candidates.cast<double>()) {
    for (int i = 0; i < p.value.size(); ++i)
      if (p.fold[static_cast<std::size_t>(i)] > 0) used.push_back(i);
    for (int trace = 0; trace < 6; ++trace) {
      std::vector<int> rows;
      for (const int i : used)
        if (p.zero[static_cast<std::size_t>(i)] == trace) rows.push_back(i);
      if (rows.empty()) continue;
      const Eigen::RowVectorXd w = weight(rows).transpose() / weight(rows).sum();
      const double mean = w * value(rows);
      const Eigen::RowVectorXd of_model = w * model(rows, Eigen::all),
                               of_candidates = w * candidates(rows, Eigen::all);
      for (const int i : rows) {
        value[i] -= mean;
        model.row(i) -= of_model;
        candidates.row(i) -= of_candidates;
      }
    }
  }
  /// Weighted products of two columns over the used values that `wanted` says.
  template <class Wanted>
  [[nodiscard]] double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                               const Wanted& wanted) const {
    double sum = 0.0;
    for (const int i : used)
      if (wanted(static_cast<std::size_t>(i))) sum += weight[i] * a[i] * b[i];
    return sum;
  }
};

TEST(DiscoverySums, AreThoseOfEveryUnitAndFold) {
  for (const bool zeros : {false, true}) {
    const DiscoveryProblem problem = made_problem(1, zeros);
    BlockStatistics statistics(problem);
    CentredByHand hand(problem);
    EXPECT_EQ(statistics.add_group(4), 2);  // two columns
    hand.model.conservativeResize(Eigen::NoChange, 4);
    hand.model.rightCols(2) = hand.candidates.middleCols(problem.groups[4].first_column, 2);
    EXPECT_EQ(statistics.units(), 8);
    EXPECT_EQ(statistics.folds(), 4);
    EXPECT_EQ(statistics.used().size(), hand.used.size());
    const auto expect_sums = [&](const BlockStatistics::Sums& sums, const auto& wanted,
                                 bool with_candidates) {
      EXPECT_NEAR(sums.value_value, hand.product(hand.value, hand.value, wanted), 1e-5);
      EXPECT_NEAR(sums.weight,
                  hand.product(Eigen::VectorXd::Ones(120), Eigen::VectorXd::Ones(120), wanted),
                  1e-9);
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(sums.model_value[k], hand.product(hand.model.col(k), hand.value, wanted), 1e-5);
        for (int l = 0; l < 4; ++l)
          EXPECT_NEAR(sums.model_model(k, l),
                      hand.product(hand.model.col(k), hand.model.col(l), wanted), 1e-5);
      }
      for (int c = 0; c < hand.candidates.cols(); ++c) {
        EXPECT_NEAR(sums.candidate_value[c],
                    hand.product(hand.candidates.col(c), hand.value, wanted), 1e-4);
        for (int k = 0; k < 4 && with_candidates; ++k)
          EXPECT_NEAR(sums.model_candidate[static_cast<std::size_t>(k)][c],
                      hand.product(hand.candidates.col(c), hand.model.col(k), wanted), 1e-4);
      }
    };
    for (int unit = 0; unit < 8; ++unit)
      expect_sums(
          statistics.unit(unit), [&](std::size_t i) { return problem.unit[i] == unit; }, false);
    const auto all = [](std::size_t) { return true; };
    expect_sums(statistics.all(), all, true);
    EXPECT_NEAR(statistics.total_weight(), statistics.all().weight, 1e-9);
    for (int fold = 0; fold <= 4; ++fold) {
      const auto wanted = [&](std::size_t i) { return fold == 0 || problem.fold[i] == fold; };
      if (fold > 0) expect_sums(statistics.fold(fold), wanted, true);
      for (int g = 0; g < 24; ++g)
        for (int a = 0; a < problem.groups[g].columns; ++a)
          for (int b = 0; b < problem.groups[g].columns; ++b)
            EXPECT_NEAR(
                statistics.group_gram(g, fold)(a, b),
                hand.product(hand.candidates.col(problem.groups[g].first_column + a),
                             hand.candidates.col(problem.groups[g].first_column + b), wanted),
                1e-4);
    }
  }
}

TEST(DiscoverySums, AZeroTakesWhatThePartsOfItsTraceShare) {
  const DiscoveryProblem problem = made_problem(2, true);
  const BlockStatistics statistics(problem);
  const CentredByHand hand(problem);
  for (const int g : {0, 1, 2, 5, 14}) {
    const CandidateGroup& group = problem.groups[g];
    Eigen::MatrixXd loss = Eigen::MatrixXd::Zero(group.columns, group.columns);
    for (int trace = 0; trace < 6; ++trace) {
      double weight = 0.0;
      std::map<int, Eigen::VectorXd> parts;
      for (const int i : hand.used) {
        if (problem.zero[static_cast<std::size_t>(i)] != trace) continue;
        Eigen::VectorXd& part = parts
                                    .try_emplace(problem.unit[static_cast<std::size_t>(i)],
                                                 Eigen::VectorXd::Zero(group.columns))
                                    .first->second;
        part += hand.weight[i] *
                hand.candidates.row(i).segment(group.first_column, group.columns).transpose();
        weight += hand.weight[i];
      }
      for (const auto& [unit, part] : parts) loss += part * part.transpose() / weight;
    }
    EXPECT_LT((statistics.zero_loss(g) - loss).norm(), 1e-4) << g;
  }
}

/// What the fit of the model leaves of values and candidates.
struct LeftByHand : CentredByHand {
  explicit LeftByHand(const DiscoveryProblem& p) : CentredByHand(p) {
    if (model.cols() == 0) return;
    const Eigen::MatrixXd f = model(used, Eigen::all);
    const Eigen::VectorXd w = weight(used);
    const Eigen::MatrixXd weighted = w.asDiagonal() * f;
    const SquareSolver normal(f.transpose() * weighted);
    const Eigen::VectorXd of_value = normal.solve_columns(weighted.transpose() * value(used));
    const Eigen::MatrixXd of_candidates =
        normal.solve_columns(weighted.transpose() * candidates(used, Eigen::all));
    value -= model * of_value;
    candidates -= model * of_candidates;
  }
};

TEST(StructureTest, OfALocalGroupIsStudentsTestAgainstTheOthersOfItsFamily) {
  for (const int nuisance : {0, 2}) {
    DiscoveryProblem problem = made_problem(3, false, nuisance);
    problem.value += 1.2 * problem.candidates.col(problem.groups[17].first_column).cast<double>();
    const BlockStatistics statistics(problem);
    std::vector<int> columns(static_cast<std::size_t>(nuisance));
    std::iota(columns.begin(), columns.end(), 0);
    const StructureTest test = test::structure_beside(problem, statistics, columns, 99);
    const LeftByHand hand(problem);
    std::vector<double> scores;
    const auto all = [](std::size_t) { return true; };
    for (int g = 12; g < 24; ++g) {
      const Eigen::VectorXd own = hand.candidates.col(problem.groups[g].first_column);
      scores.push_back(hand.product(own, hand.value, all) / std::sqrt(hand.product(own, own, all)));
    }
    double least = 1.0;
    int most_likely = -1;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      double mean = 0.0, variance = 0.0;
      for (std::size_t k = 0; k < scores.size(); ++k) mean += k == i ? 0.0 : scores[k] / 11.0;
      for (std::size_t k = 0; k < scores.size(); ++k)
        variance += k == i ? 0.0 : std::pow(scores[k] - mean, 2) / 10.0;
      const double t = (scores[i] - mean) / std::sqrt(variance * (1.0 + 1.0 / 11.0));
      const double p = std::min(1.0, 12.0 * student_two_sided(std::abs(t), 10.0));
      if (p >= least) continue;
      least = p;
      most_likely = static_cast<int>(i) + 12;
    }
    EXPECT_EQ(most_likely, 17);
    EXPECT_EQ(test.most_likely_local(), most_likely);
    EXPECT_NEAR(test.local_p_value(), least, 1e-4 * least);
    // a banned one is not asked, and counts for nothing
    std::vector<bool> banned(problem.groups.size(), false);
    banned[17] = true;
    const StructureTest without = test::structure_beside(problem, statistics, columns, 99, banned);
    EXPECT_NE(without.most_likely_local(), 17);
    EXPECT_GT(without.local_p_value(), 10.0 * least);
  }
}

TEST(StructureTest, ByFlipsFindsWhatIsThereAndSeldomWhatIsNot) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    DiscoveryProblem problem = made_problem(seed, seed % 2 == 0);
    for (int i = 0; i < 120; ++i) problem.unit[static_cast<std::size_t>(i)] = i / 3;
    const BlockStatistics nothing(problem);
    alarms += test::structure_beside(problem, nothing, {0, 1}, 99).p_value() < 0.055;
    const int hidden = static_cast<int>(seed % 12);
    const CandidateGroup& group = problem.groups[hidden];
    for (int k = 0; k < group.columns; ++k)
      problem.value += 1.5 * problem.candidates.col(group.first_column + k).cast<double>();
    const BlockStatistics statistics(problem);
    const StructureTest test = test::structure_beside(problem, statistics, {0, 1}, 99);
    EXPECT_EQ(test.most_likely(), hidden) << seed;
    EXPECT_DOUBLE_EQ(test.p_value(), 0.01) << seed;  // none of 99 flips has as much
    EXPECT_EQ(test.p_value(), test.p_value_of(hidden));
    EXPECT_LT(test.most_likely_single_p_value(), 2e-3);
  }
  EXPECT_LE(alarms, 8);  // 3 are expected; nine or more come once in 400 such tests
}

TEST(StructureTest, WhatTheModelHoldsCannotBeSeen) {
  DiscoveryProblem problem = made_problem(5, false);
  problem.candidates.col(0) = problem.nuisance.col(0).cast<float>();          // group 0
  problem.candidates.col(2) = (problem.nuisance.col(1) * 2.0).cast<float>();  // of group 1
  problem.candidates.col(problem.groups[5].first_column + 1) =
      problem.candidates.col(problem.groups[5].first_column);
  problem.candidates.col(problem.groups[9].first_column).setZero();
  const BlockStatistics statistics(problem);
  const StructureTest test = test::structure_beside(problem, statistics, {0, 1}, 19);
  for (int g = 0; g < 24; ++g) {
    const bool hidden = g == 0 || g == 1 || g == 5 || g == 9;
    EXPECT_EQ(test.observable()[static_cast<std::size_t>(g)], !hidden) << g;
    if (hidden) {
      EXPECT_EQ(test.p_value_of(g), 1.0);
    }
  }
}

std::vector<int> chosen(const DiscoveryResult& result) {
  std::vector<int> groups;
  for (const ChosenGroup& c : result.chosen) groups.push_back(c.group);
  std::sort(groups.begin(), groups.end());
  return groups;
}

TEST(Discovery, FindsWhatIsHiddenAndNothingElse) {
  const DiscoveryResult two = discover(holding({{3, 1.5}, {7, -1.2}}), {.flips = 199});
  EXPECT_EQ(chosen(two), (std::vector<int>{3, 7}));
  EXPECT_LT(two.first_p_value, 0.01);
  EXPECT_GT(two.p_left, 0.01);
  const DiscoveryResult local = discover(holding({{15, 2.5}}), {.flips = 199});
  EXPECT_EQ(chosen(local), (std::vector<int>{15}));
  EXPECT_TRUE(discover(holding({}), {.flips = 199}).chosen.empty());
  // no more than are asked for
  EXPECT_EQ(
      discover(holding({{3, 1.5}, {7, -1.2}}), {.flips = 199, .most_effects = 1}).chosen.size(),
      1u);
}

TEST(Discovery, FindsWhatIsCommonBesideWhatIsOnOnePlaceAlone) {
  for (const double height : {2.5, 8.0})
    EXPECT_EQ(chosen(discover(holding({{3, 1.0}, {15, height}}), {.flips = 199})),
              (std::vector<int>{3, 15}));
}

TEST(Discovery, OfTwinsThePreferredOneIsChosenAndTheOtherIsConfounded) {
  for (const int better : {3, 6}) {
    DiscoveryProblem problem = made_problem(7, false);
    for (int i = 0; i < 120; ++i) problem.unit[static_cast<std::size_t>(i)] = i / 3;
    const int first = problem.groups[3].first_column, twin = problem.groups[6].first_column;
    problem.candidates.col(twin) = 2.0f * problem.candidates.col(first);
    problem.value += 1.5 * problem.candidates.col(first).cast<double>();
    for (const int g : {3, 6}) problem.groups[g].preference = g == better ? 1 : 2;
    const DiscoveryResult result = discover(problem, {.flips = 199});
    ASSERT_EQ(chosen(result), std::vector<int>{better});
    EXPECT_EQ(result.chosen[0].confounded, std::vector<int>{9 - better});
    // where one is banned the other one is chosen, though it is not preferred
    std::vector<bool> banned(problem.groups.size(), false);
    banned[static_cast<std::size_t>(better)] = true;
    EXPECT_EQ(chosen(discover(problem, {.flips = 199, .banned = banned})),
              std::vector<int>{9 - better});
    // kin are one effect: not each other's rivals
    problem.groups[3].kin = problem.groups[6].kin = 1;
    const DiscoveryResult kin = discover(problem, {.flips = 199});
    ASSERT_EQ(chosen(kin), std::vector<int>{better});
    EXPECT_TRUE(kin.chosen[0].confounded.empty());
  }
}

TEST(Discovery, OneEffectThatIsTwoOthersTakesTheirPlace) {
  DiscoveryProblem problem = holding({{3, 1.5}, {6, 1.5}});
  const int a = problem.groups[3].first_column, b = problem.groups[6].first_column,
            sum = problem.groups[9].first_column;
  problem.candidates.col(sum) = problem.candidates.col(a) + problem.candidates.col(b);
  EXPECT_EQ(chosen(discover(problem, {.flips = 199})), std::vector<int>{9});
}

TEST(Discovery, GainsAreWhatTheFoldsSayWithoutTheEffect) {
  const DiscoveryProblem problem = holding({{3, 1.5}});
  const DiscoveryResult result = discover(problem, {.flips = 199});
  ASSERT_EQ(chosen(result), std::vector<int>{3});
  Eigen::MatrixXd with(120, 3);
  with << problem.nuisance, problem.candidates.col(problem.groups[3].first_column).cast<double>();
  std::vector<double> gains;
  double weight = 0.0;
  const auto error = [&](const Eigen::MatrixXd& columns, int fold, bool everywhere) {
    std::vector<int> learnt, asked;
    for (int i = 0; i < 120; ++i) {
      const int own = problem.fold[static_cast<std::size_t>(i)];
      if (own == 0) continue;
      if (everywhere || own != fold) learnt.push_back(i);
      if (everywhere || own == fold) asked.push_back(i);
    }
    const Eigen::VectorXd root = problem.weight.cwiseSqrt();
    const Eigen::MatrixXd c = root.asDiagonal() * columns;
    const Eigen::VectorXd y = root.cwiseProduct(problem.value);
    const Eigen::VectorXd fit = least_squares(c(learnt, Eigen::all), y(learnt));
    return (y(asked) - c(asked, Eigen::all) * fit).squaredNorm();
  };
  for (int fold = 1; fold <= 4; ++fold)
    gains.push_back(error(problem.nuisance, fold, false) - error(with, fold, false));
  for (int i = 0; i < 120; ++i)
    if (problem.fold[static_cast<std::size_t>(i)] > 0) weight += problem.weight[i];
  const double sum = std::accumulate(gains.begin(), gains.end(), 0.0);
  double squares = 0.0;
  for (const double gain : gains) squares += std::pow(gain - 0.25 * sum, 2);
  const ChosenGroup& found = result.chosen[0];
  EXPECT_NEAR(found.gain, sum / weight, 1e-5);
  EXPECT_NEAR(found.gain_error, std::sqrt(4.0 * squares / 3.0) / weight, 1e-5);
  const double n = 40.0 * 4.0;  // units and folds
  EXPECT_NEAR(found.bic_gain,
              n * std::log(error(problem.nuisance, 1, true) / error(with, 1, true)) - std::log(n),
              1e-3);
}

TEST(PanelRows, AreAddedAndSubtractedColumnByColumn) {
  PanelRow row{}, other{};
  for (std::size_t j = 0; j < kPanelColumns; ++j) {
    row[j] = 1.0 + 0.5 * static_cast<double>(j);
    other[j] = 3.0 - 0.25 * static_cast<double>(j * j % 7);
  }
  const Panel both{row, other};
  const double factors[] = {2.0, -3.0};
  PanelRow added = row, added_too = other, subtracted = row;
  const PanelRow* const where[] = {&both[0], &both[1]};
  const double more[] = {0.5, 4.0};
  add_rows(added, factors, added_too, more, where, 2);
  subtract_rows(subtracted, factors, both.data(), 2);
  std::vector<PanelRow> products(3, row), less(3, row), mixed(3, row);
  add_products(products, 2.0, other);
  subtract_products(less, row, other);
  add_mixed_products(mixed.data(), mixed.size(), row, other, 0.5);
  for (std::size_t j = 0; j < kPanelColumns; ++j) {
    EXPECT_DOUBLE_EQ(added[j], row[j] + 2.0 * row[j] - 3.0 * other[j]);
    EXPECT_DOUBLE_EQ(subtracted[j], row[j] - 2.0 * row[j] + 3.0 * other[j]);
    EXPECT_DOUBLE_EQ(added_too[j], other[j] + 0.5 * row[j] + 4.0 * other[j]);
    for (std::size_t apart = 0; apart < 3; ++apart) {
      const bool inside = j + apart < kPanelColumns;
      EXPECT_DOUBLE_EQ(products[apart][j],
                       row[j] + (inside ? 2.0 * other[j] * other[j + apart] : 0.0));
      EXPECT_DOUBLE_EQ(less[apart][j], row[j] - (inside ? row[j] * other[j + apart] : 0.0));
      EXPECT_DOUBLE_EQ(mixed[apart][j],
                       row[j] + (inside ? row[j] * other[j + apart] + other[j] * row[j + apart] +
                                              0.5 * row[j] * row[j + apart]
                                        : 0.0));
    }
  }
}

std::vector<int> places(int n) {
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// One series of noise with something on it, and beside it one of noise alone.
template <class Form>
Eigen::MatrixXd ring_of(int n, const Form& form) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd series = Eigen::MatrixXd::NullaryExpr(n, 2, [&] { return normal(random); });
  for (int i = 0; i < n; ++i) series(i, 1) += form(i);
  return series;
}

/// p of an F test of the square that a form takes out of the second series, of so many looked at.
double p_by_hand(const Eigen::MatrixXd& series, double square, double degrees, double looked_at) {
  const Eigen::VectorXd y = series.col(1).array() - series.col(1).mean();
  const double left = static_cast<double>(y.size()) - 1.0 - degrees;
  // two tests of five kinds in two series
  return 10.0 * 2.0 * looked_at *
         f_tail(square / degrees / ((y.squaredNorm() - square) / left), degrees, left);
}

TEST(RingScanFigures, OfAnArcAreTheMeanOfItsTeethOverTheOthersAndItsFTest) {
  const auto form = [](int i) { return i >= 20 || i < 3 ? 9.0 : 0.0; };  // over the seam
  const Eigen::MatrixXd series = ring_of(24, form);
  const RingFinding found = scan_ring(series, places(24), 24);
  ASSERT_EQ(found.kind, RingFinding::Kind::kArc);
  EXPECT_EQ(found.series, 1);
  EXPECT_EQ(found.first, 20);
  EXPECT_EQ(found.count, 7);
  double inside = 0.0, outside = 0.0;
  for (int i = 0; i < 24; ++i) (form(i) > 0.0 ? inside : outside) += series(i, 1);
  EXPECT_NEAR(found.amount, inside / 7.0 - outside / 17.0, 1e-9);
  const double square = found.amount * found.amount * 7.0 * 17.0 / 24.0;
  EXPECT_NEAR(found.p_value / p_by_hand(series, square, 1.0, 24.0 * 11.0), 1.0, 1e-9);
}

TEST(RingScanFigures, OfAWaveAreItsAmplitudeAndItsFTest) {
  const auto form = [](int i) { return 5.0 * std::cos(kTwoPi * 5.0 * i / 24.0 + 0.4); };
  const Eigen::MatrixXd series = ring_of(24, form);
  const RingFinding found = scan_ring(series, places(24), 24);
  ASSERT_EQ(found.kind, RingFinding::Kind::kWave);
  EXPECT_EQ(found.order, 5);
  double c = 0.0, s = 0.0;
  for (int i = 0; i < 24; ++i) {
    c += series(i, 1) * std::cos(kTwoPi * 5.0 * i / 24.0) / 12.0;
    s += series(i, 1) * std::sin(kTwoPi * 5.0 * i / 24.0) / 12.0;
  }
  EXPECT_NEAR(found.amount, std::hypot(c, s), 1e-9);
  EXPECT_NEAR(found.p_value / p_by_hand(series, 12.0 * (c * c + s * s), 2.0, 12.0), 1.0, 1e-9);
}

TEST(RingScanFigures, OfARampAreItsRiseAndItsFTest) {
  const auto form = [](int i) { return 12.0 * ((i + 17) % 24) / 24.0; };  // begins at 7
  const Eigen::MatrixXd series = ring_of(24, form);
  const RingFinding found = scan_ring(series, places(24), 24);
  ASSERT_EQ(found.kind, RingFinding::Kind::kRamp);
  EXPECT_EQ(found.first, 7);
  Eigen::VectorXd ramp(24);
  for (int i = 0; i < 24; ++i) ramp[i] = form(i) / 12.0;
  ramp.array() -= ramp.mean();
  const double slope = ramp.dot(series.col(1)) / ramp.squaredNorm();
  EXPECT_NEAR(found.amount, slope * 23.0 / 24.0, 1e-9);
  EXPECT_NEAR(found.p_value / p_by_hand(series, slope * slope * ramp.squaredNorm(), 1.0, 24.0), 1.0,
              1e-9);
}

TEST(RingScanFigures, OfACombAreItsHeightAndItsFTest) {
  const auto form = [](int i) { return i % 4 == 3 ? 7.0 : 0.0; };
  const Eigen::MatrixXd series = ring_of(24, form);
  const RingFinding found = scan_ring(series, places(24), 24);
  ASSERT_EQ(found.kind, RingFinding::Kind::kComb);
  EXPECT_EQ(found.count, 4);
  EXPECT_EQ(found.first, 3);
  double inside = 0.0, outside = 0.0;
  for (int i = 0; i < 24; ++i) (i % 4 == 3 ? inside : outside) += series(i, 1);
  EXPECT_NEAR(found.amount, inside / 6.0 - outside / 18.0, 1e-9);
  // combs of 2 (one: the other half says the same), 3, 4, 5, 6, 7 and 8
  const double square = found.amount * found.amount * 6.0 * 18.0 / 24.0;
  EXPECT_NEAR(
      found.p_value / p_by_hand(series, square, 1.0, 1.0 + 3.0 + 4.0 + 5.0 + 6.0 + 7.0 + 8.0), 1.0,
      1e-9);
}

TEST(RingScanFigures, OfASawAreTheRiseOfItsTeethAndItsFTest) {
  // Begins at 3 and then every 9 places; the last drift is cut short.
  const auto form = [](int i) { return 8.0 * (((i + 21) % 24) % 9) / 9.0; };
  const Eigen::MatrixXd series = ring_of(24, form);
  const RingFinding found = scan_ring(series, places(24), 24);
  ASSERT_EQ(found.kind, RingFinding::Kind::kSaw);
  EXPECT_EQ(found.first, 3);
  EXPECT_EQ(found.count, 9);
  Eigen::VectorXd saw(24);
  for (int i = 0; i < 24; ++i) saw[i] = form(i) / 8.0;
  saw.array() -= saw.mean();
  const double rise = saw.dot(series.col(1)) / saw.squaredNorm();
  EXPECT_NEAR(found.amount, rise, 1e-9);
  // Of 4, 6, 8 and 12 places, which close around the ring, as many starts; of the others 24.
  const double looked_at = 4.0 + 6.0 + 8.0 + 12.0 + 24.0 * 5.0;
  EXPECT_NEAR(found.p_value / p_by_hand(series, rise * rise * saw.squaredNorm(), 1.0, looked_at),
              1.0, 1e-9);
}

TEST(RingScanFigures, OfSeriesWithoutSpreadAreNothingAndOfEqualsTheFirstKind) {
  const RingFinding found = scan_ring(Eigen::MatrixXd::Constant(12, 2, 3.0), places(12), 12);
  EXPECT_EQ(found.p_value, 1.0);
  EXPECT_EQ(found.series, -1);
  EXPECT_EQ(found.kind, RingFinding::Kind::kArc);
}

/// Straight lines that meet, in units of the course.
TEST(CourseScanFigures, AKinkHasTheSlopesToItsSides) {
  constexpr int kPlaces = 60, kCourses = 6;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const auto& [at, before, beyond] : {std::tuple{0.4, 3.0, -5.0}, {0.7, -2.0, 6.0}}) {
    Eigen::MatrixXd courses(kPlaces, kCourses);
    for (int c = 0; c < kCourses; ++c)
      for (int i = 0; i < kPlaces; ++i) {
        const double off = i / (kPlaces - 1.0) - at;
        courses(i, c) = (off < 0.0 ? before : beyond) * off + 0.02 * normal(random);
      }
    courses.rowwise() -= courses.colwise().mean().eval();
    const auto found = scan_courses({courses});
    const auto kink = std::find_if(found.begin(), found.end(), [](const CourseFinding& f) {
      return f.kind == CourseFinding::Kind::kKink;
    });
    ASSERT_NE(kink, found.end());
    EXPECT_NEAR(kink->at, at, 0.02);
    // The bend lies on one of the places, a sixtieth apart: of 0.3 of the course a twentieth.
    EXPECT_NEAR(kink->before, before, 0.05 * std::abs(beyond - before));
    EXPECT_NEAR(kink->beyond, beyond, 0.05 * std::abs(beyond - before));
  }
}

// Of a course that is cut into as many equal rows as it has values; its bend between two of them.
TEST(CourseScanFigures, AKinkBetweenTwoRowsIsToldToTheDigit) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(-4.0, 4.0);
  for (int trial = 0; trial < 20; ++trial) {
    const int places = 40 + trial, end = std::max(3, places / 16);
    const int bend = end + (7 * trial) % (places - 2 * end + 1);
    const double at = static_cast<double>(bend) / places, before = any(random);
    const double beyond = before + (trial % 2 == 0 ? 3.0 : -5.0);
    Eigen::MatrixXd courses =
        Eigen::MatrixXd::NullaryExpr(places, 5, [&] { return 1e-6 * normal(random); });
    for (int i = 0; i < places; ++i) {
      const double off = (i + 0.5) / places - at;
      courses.row(i).array() += (off < 0.0 ? before : beyond) * off;
    }
    courses.rowwise() -= courses.colwise().mean().eval();
    const auto found = scan_courses({courses});
    const auto kink = std::find_if(found.begin(), found.end(), [](const CourseFinding& f) {
      return f.kind == CourseFinding::Kind::kKink;
    });
    ASSERT_NE(kink, found.end()) << trial;
    EXPECT_DOUBLE_EQ(kink->at, at) << trial;
    EXPECT_NEAR(kink->before, before, 1e-4) << trial;
    EXPECT_NEAR(kink->beyond, beyond, 1e-4) << trial;
    EXPECT_NEAR(kink->amount, (beyond - before) * (1.0 - at), 1e-4) << trial;
  }
}

TEST(ChanceOfAgreement, IsStudentsOfTheCorrelation) {
  Eigen::VectorXd a(6), b(6);
  a << 1.0, 4.0, 2.0, 7.0, 5.0, 3.0;
  b << 2.0, 3.0, 2.5, 6.0, 4.0, 4.5;
  // r by hand: means 22 / 6 and 22 / 6
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (int i = 0; i < 6; ++i) {
    aa += (a[i] - 22.0 / 6.0) * (a[i] - 22.0 / 6.0);
    bb += (b[i] - 22.0 / 6.0) * (b[i] - 22.0 / 6.0);
    ab += (a[i] - 22.0 / 6.0) * (b[i] - 22.0 / 6.0);
  }
  const double r = ab / std::sqrt(aa * bb), t = r * std::sqrt(4.0 / (1.0 - r * r));
  EXPECT_NEAR(chance_of_agreement(a, b), student_two_sided(t, 4.0), 1e-12);
  EXPECT_NEAR(chance_of_agreement(a, 3.0 - 2.0 * b.array()), student_two_sided(t, 4.0), 1e-12);
  EXPECT_LT(chance_of_agreement(a, a), 1e-9);
  EXPECT_EQ(chance_of_agreement(a.head(4), a.head(4)), 1.0);
  EXPECT_EQ(chance_of_agreement(a, Eigen::VectorXd::Constant(6, 2.0)), 1.0);
}

TEST(ChanceOfAgreement, OfNoiseIsAsOftenBelowALevelAsTheLevelSays) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  int below = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto a = Eigen::VectorXd::NullaryExpr(8, [&] { return normal(random); }).eval();
    const auto b = Eigen::VectorXd::NullaryExpr(8, [&] { return 9.0 * normal(random); }).eval();
    below += chance_of_agreement(a, b) < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(below, 0.05 * kTrials, 4.0 * std::sqrt(0.05 * 0.95 * kTrials));
}

}  // namespace
}  // namespace trueflank::loop
