// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_remainder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/survey_size.h"

namespace trueflank::loop {
namespace {

constexpr double kRatio = 4.0;

/// 144 set points of both directions, shuffled in each of two passes; noise of 1 % of the largest
/// torque.
struct Bench {
  BenchTable table;
  Eigen::VectorXd left;

  Bench(
      std::uint64_t seed, double correlation,
      const std::function<double(const BenchPoint&)>& structure = [](auto&) { return 0.0; }) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (int pass = 0; pass < 2; ++pass) {
      const auto first = static_cast<std::ptrdiff_t>(table.points.size());
      for (const bool forward : {true, false})
        for (const double speed : {80.0, 160.0, 330.0, 700.0, 1400.0, 3000.0})
          for (const double load : {0.1, 0.8, 1.7, 2.9, 4.0, 5.0}) {
            BenchPoint p;
            p.forward = forward;
            p.speed_rpm = speed * (1.0 + 0.003 * normal(random));
            p.load_nm = load;
            p.sigma_nm = 0.05 * (forward ? kRatio : 1.0);
            table.points.push_back(p);
          }
      std::shuffle(table.points.begin() + first, table.points.end(), random);
    }
    left.resize(static_cast<Eigen::Index>(table.points.size()));
    double error = normal(random);
    for (std::size_t i = 0; i < table.points.size(); ++i) {
      BenchPoint& p = table.points[i];
      p.taken = static_cast<double>(i) / static_cast<double>(table.points.size() - 1);
      error = correlation * error + std::sqrt(1.0 - correlation * correlation) * normal(random);
      left[static_cast<Eigen::Index>(i)] = p.sigma_nm * (error + structure(p));
    }
    measure_extent(table);
  }
  [[nodiscard]] double correlation() const {
    Eigen::VectorXd size = left;
    for (std::size_t i = 0; i < table.points.size(); ++i)
      size[static_cast<Eigen::Index>(i)] /= table.points[i].sigma_nm;
    return correlation_of_visits(size, set_points_of(table.points));
  }
  [[nodiscard]] BenchRemainder ask() const { return ask_remainder(table, kRatio, left); }
};

TEST(BenchRemainder, NoiseIsSeldomCalledStructure) {
  unsigned alarms = 0;
  const unsigned benches = test::survey_size(34U, 100U);
  for (std::uint64_t seed = 0; seed < benches; ++seed)
    for (const double correlation : {0.0, 0.5})
      alarms += Bench(seed, correlation).ask().follows.empty() ? 0 : 1;
  EXPECT_LE(100 * alarms, 6 * benches);  // 200 runs at 0.005
}

TEST(BenchRemainder, WhatStaysInTheCornerOfLoadAndSpeedIsSeenWithItsPlaceAndTheNoiseBesideIt) {
  const auto corner = [](const BenchPoint& p) {
    return p.load_nm > 3.0 && p.speed_rpm > 1000.0 ? -6.0 : 0.0;
  };
  const Bench bench(3, 0.0, corner);
  const BenchRemainder found = bench.ask();
  ASSERT_FALSE(found.follows.empty());
  EXPECT_NE(found.follows.find("load"), std::string::npos) << found.follows;
  const double noise = 0.05 * std::sqrt(0.5 * (kRatio * kRatio + 1.0));
  EXPECT_NEAR(found.noise_nm, noise, 0.15 * noise);
  EXPECT_GT(std::sqrt(bench.left.squaredNorm() / 144.0), 1.8 * noise);
}

TEST(BenchRemainder, AZeroThatJumpsOnTheRunIsSeenThoughItsSignTurnsWithTheDirection) {
  const auto jump = [](const BenchPoint& p) {
    return (p.taken > 0.5 ? 1.5 : -1.5) * (p.forward ? 1.0 : -1.0);
  };
  const BenchRemainder found = Bench(4, 0.3, jump).ask();
  EXPECT_NE(found.follows.find("over the run"), std::string::npos) << found.follows;
}

TEST(BenchRemainder, AFewRowsFarOffAreNotCalledNoise) {
  const auto at_one_row = [](const BenchPoint& p) { return p.taken == 0.0 ? 60.0 : 0.0; };
  const BenchRemainder found = Bench(5, 0.0, at_one_row).ask();
  EXPECT_NE(found.follows.find("few"), std::string::npos) << found.follows;
  EXPECT_LT(found.noise_nm, 0.2);
}

TEST(BenchRemainder, AFrictionThatChangesOverTheRunIsToldFromAZeroThatMoves) {
  const auto wear = [](const BenchPoint& p) { return 3.0 * (p.taken - 0.5) * (p.load_nm - 2.4); };
  const BenchRemainder found = Bench(6, 0.0, wear).ask();
  EXPECT_NE(found.follows.find("over the run in proportion to the load"), std::string::npos)
      << found.follows;
}

TEST(BenchRemainder, CoarseReadingsAreNotRowsFarOff) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Bench bench(seed, 0.0);
    // Most pairs of one set point read the same: their middle scatter is zero.
    for (std::size_t i = 0; i < bench.table.points.size(); ++i) {
      double& value = bench.left[static_cast<Eigen::Index>(i)];
      const double step = 2.2 * bench.table.points[i].sigma_nm;
      value = step * std::round(value / step);
      bench.table.points[i].driven_nm = value;
    }
    EXPECT_EQ(bench.ask().follows, "") << seed;
  }
}

TEST(BenchRemainder, ErrorsThatHangTogetherAreMeasuredBesideWhatSetPointsShare) {
  const auto of_speed = [](const BenchPoint& p) { return std::log(p.speed_rpm); };
  double white = 0.0, together = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    white += Bench(seed, 0.0, of_speed).correlation() / 20.0;
    together += Bench(seed, 0.6, of_speed).correlation() / 20.0;
  }
  EXPECT_NEAR(white, 0.0, 0.1);
  EXPECT_NEAR(together, 0.5, 0.12);  // less what the slow course takes with it
}

TEST(BenchRemainder, WhatADriveRemembersOfTheSetPointBeforeIsSeen) {
  double before = 0.0;
  const Bench bench(5, 0.0, [&](const BenchPoint& p) {
    const double remembered = before > 2000.0 ? -3.0 : 0.0;
    before = p.speed_rpm;
    return remembered;
  });
  const BenchRemainder left = bench.ask();
  EXPECT_NE(left.follows.find("follows the speed of the set point before"), std::string::npos)
      << left.follows;
  const std::size_t after = left.follows.find("after ");
  ASSERT_NE(after, std::string::npos) << left.follows;
  EXPECT_NEAR(std::stod(left.follows.substr(after + 6)), 3000.0, 60.0) << left.follows;
}

}  // namespace
}  // namespace trueflank::loop
