// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/column_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace trueflank::loop {
namespace {

TEST(ColumnProducts, OfSeveralTogetherAreThoseOfEachAloneToTheLastDigit) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  // (one row of a block more and less, blocks, an odd last row; columns that fill fours and not)
  for (const Eigen::Index rows : {2, 3, 511, 512, 513, 1024, 2051})
    for (const Eigen::Index width : {1, 2, 4, 5, 11})
      for (const Eigen::Index count : {1, 2, 4, 7, 8, 13}) {
        const auto drawn = [&] { return normal(random) * std::pow(10.0, 3.0 * normal(random)); };
        const Eigen::MatrixXd columns = Eigen::MatrixXd::NullaryExpr(rows, width, drawn),
                              others = Eigen::MatrixXd::NullaryExpr(rows, count, drawn);
        std::vector<const double*> asked;
        for (Eigen::Index k = 0; k < count; ++k) asked.push_back(others.col(k).data());
        const Eigen::MatrixXd products = column_products(columns, asked);
        ASSERT_EQ(products.rows(), width);
        ASSERT_EQ(products.cols(), count);
        for (Eigen::Index k = 0; k < count; ++k) {
          Eigen::VectorXd alone(width);
          alone.noalias() = columns.transpose() * others.col(k);
          for (Eigen::Index c = 0; c < width; ++c)
            ASSERT_EQ(products(c, k), alone[c]) << rows << ' ' << width << ' ' << count;
        }
      }
}

}  // namespace
}  // namespace trueflank::loop
