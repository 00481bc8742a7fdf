// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/trend_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLevel = 0.004;

/// Normal values of unit variance, each hanging on the one before by `rho`, beside a random walk.
MatrixXd errors(std::mt19937_64& random, Index rows, Index courses, double rho, double walk) {
  std::normal_distribution<double> normal;
  MatrixXd values(rows, courses);
  for (Index c = 0; c < courses; ++c) {
    double error = normal(random), wandered = 0.0;
    for (Index i = 0; i < rows; ++i) {
      wandered += walk * normal(random);
      values(i, c) = error + wandered;
      error = rho * error + std::sqrt(1.0 - rho * rho) * normal(random);
    }
  }
  return values;
}

/// Adds a course to each by its own normal factor times `um` at the ends.
void add_own(std::mt19937_64& random, MatrixXd& values, int degree, double um) {
  std::normal_distribution<double> normal;
  const VectorXd x = VectorXd::LinSpaced(values.rows(), -1.0, 1.0);
  for (Index c = 0; c < values.cols(); ++c)
    values.col(c) += um * normal(random) * VectorXd(x.array().pow(degree));
}

TEST(OwnTrend, ErrorsThatWanderHaveNone) {
  std::mt19937_64 random(11);
  struct Kind {
    double rho, walk;
  };
  for (const auto& [rho, walk] : {Kind{0.0, 0.0}, {0.6, 0.0}, {0.95, 0.0}, {0.0, 0.1}, {0.0, 1.0}}) {
    int told = 0;
    for (int i = 0; i < 200; ++i) {
      const Index courses = i % 2 == 0 ? 4 : 24;
      const auto trend = loop::own_trend({errors(random, 60, courses, rho, walk),
                                          errors(random, 60, courses, rho, walk)});
      told += trend && trend->p_value < kLevel ? 1 : 0;
    }
    EXPECT_LE(told, 4) << rho << " " << walk;
  }
}

TEST(OwnTrend, LinesAndBowsAreFoundWithTheirSpread) {
  std::mt19937_64 random(12);
  for (const int degree : {1, 2}) {
    int found = 0;
    double spread = 0.0;
    for (int i = 0; i < 40; ++i) {
      MatrixXd left = errors(random, 80, 20, 0.3, 0.0), right = errors(random, 80, 20, 0.3, 0.0);
      add_own(random, left, degree, 3.0);
      add_own(random, right, degree, 3.0);
      const auto trend = loop::own_trend({left, right});
      if (!trend || trend->p_value > kLevel || trend->degree != degree) continue;
      ++found;
      spread += trend->spread;
    }
    EXPECT_EQ(found, 40) << degree;
    EXPECT_NEAR(spread / found, degree == 1 ? 6.0 : 3.0, 0.4) << degree;
  }
}

TEST(OwnTrend, ALineIsFoundBesideABow) {
  std::mt19937_64 random(13);
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    MatrixXd values = errors(random, 100, 8, 0.0, 0.0);
    add_own(random, values, 1, 4.0);
    add_own(random, values, 2, 1.5);
    const auto trend = loop::own_trend({values});
    found += trend && trend->p_value < kLevel && trend->degree == 1 ? 1 : 0;
  }
  EXPECT_GE(found, 36);
}

TEST(OwnTrend, WhatAllHaveInCommonIsNone) {
  std::mt19937_64 random(14);
  MatrixXd values = errors(random, 60, 12, 0.0, 0.0);
  values.colwise() += VectorXd(VectorXd::LinSpaced(60, -20.0, 20.0));
  const auto trend = loop::own_trend({values});
  ASSERT_TRUE(trend);
  EXPECT_GT(trend->p_value, kLevel);
}

/// Polynomials at right angles over the rows, each from the two before it.
MatrixXd legendre_of(Index rows, Index count) {
  const VectorXd x = VectorXd::LinSpaced(rows, -1.0, 1.0);
  MatrixXd all(rows, count);
  for (Index k = 0; k < count; ++k) {
    VectorXd next =
        k == 0 ? VectorXd(VectorXd::Ones(rows)) : VectorXd(x.cwiseProduct(all.col(k - 1)));
    for (int twice = 0; twice < 2; ++twice)
      for (Index of = std::max<Index>(0, k - 2); of < k; ++of)
        next -= next.dot(all.col(of)) * all.col(of);
    all.col(k) = next.normalized();
  }
  return all;
}

/// What the header says: each degree's power, the power laws of the degrees above, an F test.
std::optional<loop::OwnTrend> trend_by_hand(const std::vector<MatrixXd>& sets) {
  const Index rows = sets.front().rows();
  double courses = 0.0;
  for (const MatrixXd& set : sets)
    courses += set.cols() > 2 ? static_cast<double>(set.cols()) - 1.0 : 0.0;
  const auto asked = static_cast<Index>(1.0 + std::floor(100.0 / courses));
  const Index count = std::max<Index>(9, std::min({asked, Index{25}, rows / 3}));
  const MatrixXd basis = legendre_of(rows, count);
  std::vector<double> power(static_cast<std::size_t>(count));
  for (Index k = 0; k < count; ++k)
    for (const MatrixXd& set : sets)
      for (Index c = 0; c < set.cols() && set.cols() > 2; ++c) {
        const VectorXd own = set.col(c) - set.rowwise().mean();
        power[static_cast<std::size_t>(k)] += std::pow(own.dot(basis.col(k)), 2) / courses;
      }
  std::optional<loop::OwnTrend> surest;
  const auto ask = [&](int degree, std::size_t from, double still_an_error) {
    const double of_degrees = static_cast<double>(power.size() - from);
    std::vector<double> likelihoods, levels;
    for (int quarter = 0; quarter <= 12; ++quarter) {
      const auto law = [&](std::size_t k) {
        return std::pow(static_cast<double>(k), -0.25 * quarter);
      };
      double level = 0.0, likelihood = 0.0;
      for (std::size_t k = from; k < power.size(); ++k) level += power[k] / law(k) / of_degrees;
      for (std::size_t k = from; k < power.size(); ++k)
        likelihood -= 0.5 * courses * (std::log(level * law(k)) + power[k] / (level * law(k)));
      likelihoods.push_back(likelihood);
      levels.push_back(level * law(static_cast<std::size_t>(degree)));
    }
    const double best = *std::max_element(likelihoods.begin(), likelihoods.end());
    std::size_t law = likelihoods.size() - 1;
    while (likelihoods[law] < best - 2.0) --law;
    const double own = power[static_cast<std::size_t>(degree)], error = levels[law];
    const double p =
        3.0 * loop::f_tail(own / (still_an_error * error), courses, courses * of_degrees);
    if (surest && surest->p_value <= std::min(1.0, p)) return;
    const VectorXd form = basis.col(degree);
    surest = {
        .degree = degree,
        .p_value = std::min(1.0, p),
        .spread = std::sqrt(std::max(0.0, own - error)) * (form.maxCoeff() - form.minCoeff())};
  };
  ask(1, 2, 2.5);
  ask(1, 3, 4.0);
  ask(2, 3, 2.5);
  return surest;
}

TEST(OwnTrend, IsTheSurestOfItsThreeQuestions) {
  std::mt19937_64 random(16);
  int of_degree[3] = {}, doubtful = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<MatrixXd> sets;
    for (int set = 0; set < 1 + i % 2; ++set) {
      const Index courses = 2 + (i + 5 * set) % 7 + (i % 9 == 0 ? 30 : 0);
      MatrixXd& values = sets.emplace_back(
          errors(random, 16 + 7 * (i % 11), courses, 0.3 * (i % 3), i % 4 == 0 ? 0.3 : 0.0));
      if (i % 5 > 0) add_own(random, values, 1 + i / 5 % 2, 0.5 * (i % 5));
      if (i % 5 == 4) add_own(random, values, 2 - i / 5 % 2, 1.0);
    }
    if (sets[0].cols() < 3 && (sets.size() < 2 || sets[1].cols() < 3)) continue;
    const auto told = loop::own_trend(sets), known = trend_by_hand(sets);
    ASSERT_TRUE(told) << i;
    EXPECT_EQ(told->degree, known->degree) << i;
    EXPECT_NEAR(told->p_value, known->p_value, 1e-7 * known->p_value) << i;
    EXPECT_NEAR(told->spread, known->spread, 1e-7) << i;
    ++of_degree[told->degree];
    doubtful += told->p_value == 1.0 ? 1 : 0;
  }
  EXPECT_GT(std::min(of_degree[1], of_degree[2]), 5);
  EXPECT_GT(doubtful, 3);
}

// Where neither can be chance, the simpler one is told.
TEST(OwnTrend, OfALineAndABowBeyondDoubtTheLineIsTold) {
  std::mt19937_64 random(17);
  MatrixXd values = errors(random, 200, 40, 0.0, 0.0) * 1e-9;
  add_own(random, values, 2, 9.0);
  add_own(random, values, 1, 3.0);
  const auto trend = loop::own_trend({values});
  ASSERT_TRUE(trend);
  EXPECT_EQ(trend->p_value, 0.0);
  EXPECT_EQ(trend->degree, 1);
}

TEST(OwnTrend, FewCoursesOrPlacesTellNothing) {
  std::mt19937_64 random(15);
  EXPECT_FALSE(loop::own_trend({}));
  EXPECT_FALSE(loop::own_trend({errors(random, 15, 8, 0.0, 0.0)}));
  EXPECT_FALSE(loop::own_trend({errors(random, 60, 2, 0.0, 0.0)}));
  EXPECT_FALSE(loop::own_trend({MatrixXd::Zero(60, 8)}));
}

}  // namespace
}  // namespace trueflank::test
