// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/spline_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

/// One line whose height is a function of u.
LineBundle height(const std::function<double(double)>& f) {
  return [f](double u) {
    Eigen::RowVectorXd row(3);
    row << u, f(u), 0.0;
    return row;
  };
}

TEST(SplineBasis, WeightsSumToOneEverywhere) {
  for (const int degree : {1, 3, 8}) {
    const SplineBasis basis(degree, {0.0, 0.1, 0.6, 1.0});
    EXPECT_EQ(basis.count(), degree + 3);
    for (int i = 0; i <= 50; ++i) {
      const BasisWeights w = basis.at(i / 50.0);
      EXPECT_NEAR(std::accumulate(w.weight.begin(), w.weight.end(), 0.0), 1.0, 1e-14);
      EXPECT_GE(w.first, 0);
      EXPECT_LE(w.first + degree, basis.count() - 1);
    }
  }
}

TEST(SplineBasis, PolynomialsOfItsDegreeAreExact) {
  const BasisFit cubic = fit_basis(height([](double u) { return 5.0 * u * u * u - u; }), 1e-12);
  EXPECT_EQ(cubic.basis.degree(), 3);
  EXPECT_EQ(cubic.basis.count(), 4);
  EXPECT_LE(cubic.error_mm, 1e-14);
  const BasisFit sixth = fit_basis(height([](double u) { return std::pow(u, 6.0); }), 1e-12);
  EXPECT_EQ(sixth.basis.degree(), 6);
}

TEST(SplineBasis, ABendDrawsKnotsToItself) {
  const BasisFit fit = fit_basis(height([](double u) { return 1e-2 * std::abs(u - 0.3); }), 1e-6);
  EXPECT_LE(fit.error_mm, 1e-6);
  int near = 0, far = 0;
  for (const double knot : fit.basis.knots()) ++(std::abs(knot - 0.3) < 0.1 ? near : far);
  EXPECT_GT(near, far);
}

TEST(SplineBasis, WhatCannotBeFollowedSaysHowFarOffItIs) {
  const BasisFit fit = fit_basis(height([](double u) { return u < 1.0 / 3.0 ? 0.0 : 1.0; }), 1e-6);
  EXPECT_GT(fit.error_mm, 0.1);
}

TEST(SplineBasis, KnotsRunFromZeroToOne) {
  EXPECT_THROW(SplineBasis(3, {0.0, 2.0}), ContractViolation);
  EXPECT_THROW(SplineBasis(9, {0.0, 1.0}), ContractViolation);
}

}  // namespace
}  // namespace trueflank
