// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/unit_spread.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

constexpr Eigen::Index kColumns = 9;

/// Values of fitted columns (M of them) and of candidates at the points of one unit.
struct Unit {
  Eigen::MatrixXd fitted, candidates;
};

/// Fitted columns that are sums of `rank` shapes at the unit's points.
Unit unit_of_rank(Eigen::Index rank, Eigen::Index fitted, std::minstd_rand& random) {
  std::normal_distribution<double> normal;
  const auto value = [&] { return normal(random); };
  const Eigen::MatrixXd shapes = Eigen::MatrixXd::NullaryExpr(40, rank, value);
  return {shapes * Eigen::MatrixXd::NullaryExpr(rank, fitted, value),
          Eigen::MatrixXd::NullaryExpr(40, kColumns, value)};
}

Panel panel_of(const Eigen::MatrixXd& values) {
  Panel panel(static_cast<std::size_t>(values.rows()), PanelRow{});
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      panel[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = values(i, j);
  return panel;
}

TEST(UnitSpread, IsWhatTheInverseTakesOfTheUnitsProductsWhateverTheirRank) {
  std::minstd_rand random(7);
  for (const Eigen::Index fitted : {1, 4, 12})
    for (const Eigen::Index rank : {1, 3, 12}) {
      if (rank > fitted) continue;
      const Unit unit = unit_of_rank(rank, fitted, random), other = unit_of_rank(fitted, fitted, random);
      const Eigen::MatrixXd own = unit.fitted.transpose() * unit.fitted;
      const Eigen::MatrixXd inverse =
          SquareSolver(own + other.fitted.transpose() * other.fitted)
              .solve_columns(Eigen::MatrixXd::Identity(fitted, fitted));
      const Eigen::MatrixXd cross = unit.fitted.transpose() * unit.candidates;
      const Eigen::MatrixXd absorbed =
          inverse * (cross + other.fitted.transpose() * other.candidates);
      const Eigen::MatrixXd left = cross - own * absorbed;
      const Eigen::MatrixXd taken = left.transpose() * inverse * left;

      const UnitSpread spread(own, inverse);
      ASSERT_EQ(spread.rank(), static_cast<std::size_t>(rank));
      const Panel all = panel_of(cross);
      std::vector<const PanelRow*> rows;
      Panel squares(spread.rank());
      for (const std::size_t row : spread.rows()) rows.push_back(&all[row]);
      spread.spread_of(rows.data(), panel_of(absorbed), squares);
      for (Eigen::Index a = 0; a < kColumns; ++a)
        for (Eigen::Index b = 0; b < kColumns; ++b) {
          double sum = 0.0;
          for (const PanelRow& row : squares)
            sum += row[static_cast<std::size_t>(a)] * row[static_cast<std::size_t>(b)];
          EXPECT_NEAR(sum, taken(a, b), 1e-9 * std::sqrt(taken(a, a) * taken(b, b)));
        }
    }
}

TEST(UnitSpread, OfAUnitThatSeesNoFittedColumnIsNothing) {
  const UnitSpread spread(Eigen::MatrixXd::Zero(3, 3), Eigen::MatrixXd::Identity(3, 3));
  EXPECT_EQ(spread.rank(), 0U);
}

}  // namespace
}  // namespace trueflank::loop
