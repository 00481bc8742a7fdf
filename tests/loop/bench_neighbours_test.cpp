// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/support/survey_size.h"
#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

constexpr double kRatioOfRows = 3.0;

/// Rows at any speed, load and angle; noise of 1 unit, of which neighbours in time share some.
struct AnyRows {
  BenchTable table;
  Eigen::VectorXd left;
  double noise = 0.0;

  AnyRows(
      std::uint64_t seed, bool long_tails, double shared, bool both,
      const std::function<double(const BenchPoint&)>& form = [](auto&) { return 0.0; }) {
    constexpr int kRows = 240;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::student_t_distribution<double> tails(4.0);
    std::uniform_real_distribution<double> any;
    table.has_angle = true;
    table.turns = 30.0;
    left.resize(kRows);
    double last = 0.0, square = 0.0;
    for (int i = 0; i < kRows; ++i) {
      BenchPoint p;
      p.forward = !both || any(random) < 0.55;
      p.speed_rpm = 30.0 * std::pow(80.0, any(random));
      p.load_nm = 0.2 + 0.8 * any(random);
      p.angle_rad = kTwoPi * 30.0 * any(random);
      p.sigma_nm = 1.0;
      p.row = i;
      p.line = i + 2;
      p.taken = i / (kRows - 1.0);
      table.points.push_back(p);
      const double own = long_tails ? tails(random) / std::sqrt(2.0) : normal(random);
      last = shared * last + std::sqrt(1.0 - shared * shared) * own;
      square += last * last;
      left[i] = last + form(p);
    }
    noise = std::sqrt(square / kRows);
    measure_extent(table);
  }
  [[nodiscard]] SharedByNearRows ask() const {
    return ask_neighbours(table, kRatioOfRows, {}, left);
  }
};

TEST(BenchNeighbours, NoiseIsSeldomCalledAForm) {
  int alarms = 0, runs = 0;
  const auto benches = test::survey_size(20U, 100U);
  for (std::uint64_t seed = 0; seed < benches; ++seed)
    for (const double shared : {0.0, 0.6})
      for (const bool tails : {false, true})
        for (const bool both : {false, true}) {
          alarms += AnyRows(seed, tails, shared, both).ask().told.empty() ? 0 : 1;
          ++runs;
        }
  EXPECT_LE(100 * alarms, runs + 200);  // a hundredth, and two more by chance
}

TEST(BenchNeighbours, TheNoiseBesideAFormNobodyFoundIsToldWithinATenth) {
  const auto chip = [](const BenchPoint& p) {
    const double turns = p.angle_rad / kTwoPi / kRatioOfRows - 0.4,
                 x = (turns - std::round(turns)) / 0.05;
    return 6.0 * std::exp(-x * x);
  };
  const auto band = [](const BenchPoint& p) {
    return p.speed_rpm > 400.0 && p.speed_rpm < 900.0 ? -3.0 : 0.0;
  };
  const auto film = [](const BenchPoint& p) {
    return -4.0 * p.load_nm / (1.0 + std::pow(p.speed_rpm / (600.0 * p.load_nm), 2));
  };
  const auto growing = [](const BenchPoint& p) {
    return 7.0 * std::pow(p.speed_rpm / 2400.0, 2) * std::cos(p.angle_rad - 1.0);
  };
  const std::function<double(const BenchPoint&)> forms[] = {chip, band, film, growing};
  const char* over[] = {"the angle of the output", "the speed", "the speed", "the speed"};
  for (std::size_t k = 0; k < std::size(forms); ++k) {
    double sum = 0.0;
    constexpr std::uint64_t kDraws = 10;
    for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
      const AnyRows rows(50 + seed, false, 0.0, false, forms[k]);
      const SharedByNearRows found = rows.ask();
      EXPECT_NE(found.told.find(over[k]), std::string::npos) << k << ": " << found.told;
      sum += found.noise_nm / rows.noise / kDraws;
    }
    EXPECT_NEAR(sum, 1.0, 0.12) << k;
  }
}

}  // namespace
}  // namespace trueflank::loop
