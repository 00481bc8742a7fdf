// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/wave_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "tests/support/survey_size.h"
#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

TEST(WaveSpectrum, LinesSummedByTransformAreThePlainSums) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-40.0, 6000.0);
  std::normal_distribution<double> normal;
  std::vector<double> angle, size;
  double total = 0.0;
  for (int i = 0; i < 300; ++i) {
    angle.push_back(place(random));
    size.push_back(normal(random));
    total += std::abs(size.back());
  }
  for (const int lines : {5, 17, 700, 3001, 4096, 7001}) {  // (3001: a grid of threes and fives)
    const auto sums = line_sums(angle, size, 0.31, 0.0007, lines);
    ASSERT_EQ(sums.size(), static_cast<std::size_t>(lines));
    for (int k = 0; k < lines; ++k) {
      std::complex<double> plain;
      for (std::size_t i = 0; i < angle.size(); ++i)
        plain += size[i] * std::polar(1.0, (0.31 + 0.0007 * k) * angle[i]);
      EXPECT_NEAR(std::abs(sums[static_cast<std::size_t>(k)] - plain), 0.0, 1e-10 * total) << lines << " " << k;
    }
  }
}

/// Rows in both directions at angles all over so many turns, with a load that goes up and down.
BenchTable rows_over(double turns, int rows) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  BenchTable table;
  table.has_angle = true;
  table.turns = turns;
  table.most_load_nm = 2.0;
  for (int i = 0; i < rows; ++i) {
    BenchPoint p;
    p.forward = i % 3 != 0;
    p.angle_rad = kTwoPi * turns * share(random);
    p.load_nm = 1.0 + share(random);
    p.sigma_nm = 0.01;
    p.fold = i % (kBenchFolds + 1);
    table.points.push_back(p);
  }
  return table;
}

/// Noise, and a wave of so much in both directions, in opposite ways on demand.
Eigen::VectorXd left_of(const BenchTable& table, double order, double nm, bool opposite, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> noise(0.0, 0.01);
  Eigen::VectorXd left(static_cast<Eigen::Index>(table.points.size()));
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    const BenchPoint& p = table.points[static_cast<std::size_t>(i)];
    const double way = opposite && !p.forward ? -1.0 : 1.0;
    left[i] = way * nm * std::cos(order * p.angle_rad + 0.4) + noise(random);
  }
  return left;
}

TEST(WaveSpectrum, WhatIsKeptFromOneQuestionToTheNextChangesNoAnswer) {
  for (const double turns : {60.0, 2000.0}) {  // line by line, and by transforms
    const BenchTable table = rows_over(turns, 400);
    WaveSpectra kept;
    BenchTable others = table;
    others.points.resize(350);
    for (const int turn : {1, 2}) {
      (void)turn;
      for (int seed = 1; seed <= test::survey_size(2, 6); ++seed) {
        const double order = 1.3 + 1.7 * seed;
        const bool opposite = seed % 2 == 0;
        for (const BenchTable* of : {&table, static_cast<const BenchTable*>(&others)}) {
          const Eigen::VectorXd left = left_of(*of, order, 0.01, opposite, seed);
          WaveSpectra alone;
          const LikeliestOrder first = alone.likeliest_order(*of, left),
                               asked = kept.likeliest_order(*of, left);
          EXPECT_EQ(asked.order, first.order);
          EXPECT_EQ(asked.p_value, first.p_value);
          EXPECT_EQ(asked.opposite, first.opposite);
          EXPECT_EQ(asked.with_load, first.with_load);
          EXPECT_NEAR(asked.order, order, 0.25 / turns) << turns << ' ' << seed;
          EXPECT_EQ(asked.opposite, opposite) << turns << ' ' << seed;
          EXPECT_LT(asked.p_value, 1e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace trueflank::loop
