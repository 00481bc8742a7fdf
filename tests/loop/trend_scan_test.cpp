// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/trend_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(OwnTrend, FewCoursesOrPlacesTellNothing) {
  std::mt19937_64 random(15);
  EXPECT_FALSE(loop::own_trend({}));
  EXPECT_FALSE(loop::own_trend({errors(random, 15, 8, 0.0, 0.0)}));
  EXPECT_FALSE(loop::own_trend({errors(random, 60, 2, 0.0, 0.0)}));
  EXPECT_FALSE(loop::own_trend({MatrixXd::Zero(60, 8)}));
}

}  // namespace
}  // namespace trueflank::test
