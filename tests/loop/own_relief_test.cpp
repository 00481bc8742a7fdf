// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/own_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/loop/made_gears.h"

// Courses of which each has a smooth form of its own are no noise; what hangs together by itself
// is.
namespace trueflank::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using loop::own_relief;

struct Errors {
  double keeps = 0.0;  ///< share of the last error that the next one keeps
  int mean_of = 1;     ///< values in a row: a filter
};
MatrixXd errors_of(const Errors& kind, Index rows, Index courses, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  MatrixXd set(rows, courses);
  for (Index c = 0; c < courses; ++c) {
    std::vector<double> all;
    double last = 0.0;
    for (Index i = 0; i < rows + 20; ++i) all.push_back(last = kind.keeps * last + normal(random));
    for (Index i = 0; i < rows; ++i) {
      double sum = 0.0;
      for (int k = 0; k < kind.mean_of; ++k) sum += all[static_cast<std::size_t>(10 + i - k)];
      set(i, c) = sum / kind.mean_of;
    }
  }
  return set;
}

/// Forms of six waves each, of two waves a course and longer.
void add_reliefs(MatrixXd& set, double um, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, um / std::sqrt(5.0));
  const auto rows = static_cast<double>(set.rows());
  for (Index c = 0; c < set.cols(); ++c)
    for (int k = 1; k <= 5; ++k) {
      const double size = std::sqrt(2.0) * normal(random);
      for (Index i = 0; i < set.rows(); ++i)
        set(i, c) += size * std::cos(M_PI * k * (static_cast<double>(i) + 0.5) / rows);
    }
}

TEST(OwnRelief, IsNotWhatHangsTogetherByItself) {
  for (const Errors& kind :
       {Errors{}, Errors{0.5}, Errors{0.8}, Errors{0.92}, Errors{0.0, 3}, Errors{0.0, 5}})
    for (const Index courses : {4, 12}) {
      int alarms = 0;
      for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 random(seed);
        const auto found = own_relief(
            {errors_of(kind, 60, courses, random), errors_of(kind, 60, courses, random)});
        alarms += found && found->p_value < 0.004 ? 1 : 0;
      }
      EXPECT_LE(alarms, 1) << kind.keeps << " " << kind.mean_of << " " << courses;
    }
}

TEST(OwnRelief, IsFoundWithItsSizeBesideErrorsOfSingleValues) {
  for (const Index courses : {4, 12, 40}) {
    int found = 0;
    double spread = 0.0, waves = 0.0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937_64 random(100 + seed);
      std::vector<MatrixXd> sets{errors_of({}, 60, courses, random),
                                 errors_of({}, 60, courses, random)};
      for (MatrixXd& set : sets) add_reliefs(set, 2.5, random);
      const auto relief = own_relief(sets);
      if (!relief || relief->p_value > 0.004) continue;
      ++found;
      spread += relief->spread;
      waves += relief->waves;
    }
    EXPECT_GE(found, courses > 4 ? 20 : 15) << courses;
    EXPECT_NEAR(spread / found, 2.5, 0.25) << courses;
    EXPECT_NEAR(waves / found, 2.5, courses > 4 ? 0.3 : 0.8) << courses;
  }
}

TEST(OwnRelief, OfOneLengthHasThatLength) {
  // (its longest waves are nothing: it was told in waves of infinite length)
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0.0, 5.0);
  MatrixXd set = errors_of({}, 60, 12, random);
  for (Index c = 0; c < set.cols(); ++c) {
    const double size = normal(random);
    for (Index i = 0; i < set.rows(); ++i)
      set(i, c) += size * std::cos(M_PI * 4.0 * (static_cast<double>(i) + 0.5) / 60.0);
  }
  const auto relief = own_relief({set});
  ASSERT_TRUE(relief);
  EXPECT_EQ(relief->waves, 2.0);
}

TEST(OwnRelief, OfOneTraceIsNone) {
  std::mt19937_64 random(5);
  MatrixXd set = errors_of({}, 60, 12, random), one = set.leftCols(1);
  add_reliefs(one, 8.0, random);
  set.col(0) = one;
  EXPECT_FALSE(own_relief({set}));
}

TEST(OwnRelief, OfEveryTraceIsToldAndNoNoise) {
  // (it was `no_effect`, with all of it called noise)
  for (const unsigned seed : {1U, 2U}) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    const MadeGear gear = spur(29);
    std::vector<double> sizes(static_cast<std::size_t>(2 * 30 * 2 * 4));
    for (double& size : sizes) size = normal(random);
    const auto hammered = grown([&](auto&, const FlankSpot& s, auto&) {
      const std::size_t first = static_cast<std::size_t>(2 * s.tooth + (s.side > 0 ? 1 : 0)) * 8;
      double um = 0.0;
      for (std::size_t k = 0; k < 4; ++k)
        um +=
            sizes[first + k] * std::cos(M_PI * 0.5 * (static_cast<double>(k) + 1.0) * (s.u + 1.0)) +
            sizes[first + 4 + k] *
                std::cos(M_PI * 0.5 * (static_cast<double>(k) + 1.0) * (s.v + 1.0));
      return 2.0 * um;
    });
    // (in an index every flank stands by itself, and nothing tells that from its errors)
    InspectionOptions options{.points = 60, .noise_um = 1.0, .index = false, .seed = seed};
    if (seed == 2U) options.teeth = {1, 4, 8, 12, 16, 20, 24, 27};
    const auto result = close(gear, inspection_of(gear, {hammered}, options));
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained) << list(result);
    EXPECT_NE(result.structure_left.find("has a smooth form of its own, in waves of"),
              std::string::npos)
        << result.structure_left << list(result);
    EXPECT_NEAR(result.noise, 1.0, 0.15) << seed;
  }
}

}  // namespace
}  // namespace trueflank::test
