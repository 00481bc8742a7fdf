// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

// Closed forms of few degrees of freedom: 1 (Cauchy), 2 and 4.
TEST(Distributions, StudentsTailsAgreeWithClosedForms) {
  for (double t : {0.01, 0.5, 1.0, 3.0, 40.0, 1e4}) {
    const double cauchy = 2.0 / kPi * std::atan2(1.0, t);
    EXPECT_NEAR(student_two_sided(t, 1.0), cauchy, 1e-13 + 1e-11 * cauchy) << t;
    const double root = std::sqrt(2.0 + t * t), two = 2.0 / (root * (root + t));
    EXPECT_NEAR(student_two_sided(t, 2.0), two, 1e-11 * two) << t;
  }
  // A quantile printed in every table: t(0.975; 10).
  EXPECT_NEAR(student_95(10.0), 2.2281388520, 1e-9);
}

TEST(Distributions, LongTailsRaiseTheNormalTailAsAMixtureOfSpreadsDoes) {
  for (double z : {0.3, 2.0, 5.0, 9.0})
    EXPECT_NEAR(normal_two_sided(z), std::erfc(z / std::sqrt(2.0)), 1e-16);
  // Normal values of two spreads, as often of the one as of the other: variance 1, kurtosis 3 (1 +
  // d^2).
  const double d = 0.2, excess = 3.0 * d * d;
  for (double z : {2.5, 3.0, 3.5}) {
    const double mixed = 0.5 * std::erfc(z / std::sqrt(2.0 * (1.0 - d))) +
                         0.5 * std::erfc(z / std::sqrt(2.0 * (1.0 + d)));
    EXPECT_NEAR(normal_two_sided(z, excess), mixed, 0.15 * mixed) << z;
    EXPECT_GT(normal_two_sided(z, excess), 1.05 * normal_two_sided(z)) << z;
  }
  // Short tails are taken as normal.
  EXPECT_EQ(normal_two_sided(4.0, -1.0), normal_two_sided(4.0));
}

// F with 2 degrees above: (1 + 2 f / n)^(-n / 2).
TEST(Distributions, TheFTailAgreesWithItsClosedForm) {
  for (double f : {0.1, 1.0, 7.0, 300.0})
    for (double below : {1.0, 5.0, 60.0, 1e5}) {
      const double closed = std::exp(-0.5 * below * std::log1p(2.0 * f / below));
      EXPECT_NEAR(f_tail(f, 2.0, below), closed, 1e-10 * closed) << f << ' ' << below;
    }
  EXPECT_EQ(f_tail(0.0, 2.0, 5.0), 1.0);
}

TEST(Distributions, NoNumberGivesNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(student_two_sided(none, 3.0)));
  EXPECT_TRUE(std::isnan(student_two_sided(1.0, none)));
}

// The tail's integral by Simpson's rule over what lies beyond x, scaled so that nothing underflows.
double minus_log_tail(double x, int degrees) {
  constexpr int kSteps = 40000;
  const double step = 120.0 / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double u = step * i, weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(x + u, 0.5 * degrees - 1.0) * std::exp(-0.5 * u);
  }
  return 0.5 * x + 0.5 * degrees * std::log(2.0) + std::lgamma(0.5 * degrees) -
         std::log(sum * step / 3.0);
}

TEST(Distributions, ChiSquareIsTheIntegralOfItsDensity) {
  for (int degrees = 1; degrees <= 8; ++degrees)
    for (double x : {0.3, 2.0, 11.0, 90.0, 700.0})
      EXPECT_NEAR(minus_log_chi_square_tail(x, degrees), minus_log_tail(x, degrees), 1e-8)
          << x << ' ' << degrees;
}

TEST(Distributions, ChiSquareStaysExactWhereErfcUnderflows) {
  for (int degrees = 1; degrees <= 8; ++degrees)
    for (double x : {801.0, 1500.0, 1e5})
      EXPECT_NEAR(minus_log_chi_square_tail(x, degrees), minus_log_tail(x, degrees), 1e-5)
          << x << ' ' << degrees;
}

TEST(Distributions, OfNothingBeyondZeroIsTheWholeTail) {
  for (int degrees : {1, 2, 5}) {
    EXPECT_EQ(minus_log_chi_square_tail(0.0, degrees), 0.0);
    EXPECT_EQ(minus_log_chi_square_tail(-3.0, degrees), 0.0);
  }
  EXPECT_EQ(f_tail(-1.0, 2.0, 5.0), 1.0);
}

// t(0.975; n) of printed tables.
TEST(Distributions, StudentsLimitsAreTheTables) {
  EXPECT_NEAR(student_95(1.0), 12.706, 5e-4);
  EXPECT_NEAR(student_95(2.0), 4.303, 5e-4);
  EXPECT_NEAR(student_95(30.0), 2.042, 5e-4);
  EXPECT_NEAR(student_95(1e6), 1.960, 5e-4);
}

// 2 degrees: exp(-x / 2); 1 degree: erfc(sqrt(x / 2)); far beyond where the tail itself underflows.
TEST(Distributions, ChiSquareKeepsItsLogarithm) {
  EXPECT_NEAR(minus_log_chi_square_tail(12.0, 2), 6.0, 1e-12);
  EXPECT_NEAR(minus_log_chi_square_tail(9.0, 1), -std::log(std::erfc(std::sqrt(4.5))), 1e-12);
  EXPECT_NEAR(minus_log_chi_square_tail(1e6, 2), 5e5, 1e-6);
}

// Of sizes with an exponential tail the p value is even between 0 and 1, however many they are.
TEST(Distributions, TheLargestOfAnExponentialTailIsAnAccidentAsOftenAsItSays) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> size(3.0);
  for (const std::size_t count : {12U, 60U}) {
    constexpr int kTrials = 4000;
    int below = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> sizes(count);
      for (double& one : sizes) one = size(random);
      std::swap(*std::max_element(sizes.begin(), sizes.end()), sizes.back());
      const double largest = sizes.back();
      sizes.pop_back();
      below += gap_beyond_tail_p_value(largest, sizes) < 0.05 ? 1 : 0;
    }
    EXPECT_NEAR(below, 0.05 * kTrials, 4.0 * std::sqrt(0.05 * 0.95 * kTrials)) << count;
  }
}

// The gaps between sorted sizes of an exponential tail, each times its rank, are draws of one
// exponential (Renyi): eight of few sizes, a third of many.
TEST(Distributions, TheLargestIsJudgedByTheGapsOfTheTailAlone) {
  for (const auto& [count, in_tail] : {std::pair{5, 5}, {9, 8}, {20, 8}, {60, 20}}) {
    std::vector<double> others{100.0};
    double sum = 0.0;
    for (int rank = 2; rank <= count; ++rank) {
      const double gap = rank <= in_tail ? 0.3 + 0.1 * (rank % 3) : 1.0;
      if (rank <= in_tail) sum += rank * gap;
      others.push_back(others.back() - gap);
    }
    EXPECT_NEAR(gap_beyond_tail_p_value(104.0, others), std::pow(1.0 + 4.0 / sum, 1 - in_tail),
                1e-12)
        << count;
  }
}

TEST(Distributions, OneSizeFarBeyondTheOthersIsNone) {
  std::vector<double> others;
  for (int i = 0; i < 30; ++i) others.push_back(0.1 * i);
  EXPECT_EQ(gap_beyond_tail_p_value(2.8, others), 1.0);
  EXPECT_GT(gap_beyond_tail_p_value(3.2, others), 0.2);
  EXPECT_LT(gap_beyond_tail_p_value(15.0, others), 1e-4);
  EXPECT_EQ(gap_beyond_tail_p_value(15.0, {1.0, 2.0, 3.0}), 1.0);  // too few to say
}

// Of the sizes of normal values the next one's tail is nearly normal, of exponential ones
// exponential.
TEST(Distributions, TailsOfTheOthersSayHowFarOneMoreMayReach) {
  std::vector<double> normal, exponential;
  constexpr int kCount = 200;
  for (int i = 0; i < kCount; ++i) {
    const double share = (i + 0.5) / kCount;
    exponential.push_back(-std::log(1.0 - share));
    double low = 0.0, high = 10.0;  // the size that so many normal values stay below
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (1.0 - normal_two_sided(middle) < share ? low : high) = middle;
    }
    normal.push_back(low);
  }
  const double p_normal = beyond_tails_alike_p_value(4.5, normal);
  EXPECT_GT(p_normal, normal_two_sided(4.5));
  EXPECT_LT(p_normal, 30.0 * normal_two_sided(4.5));
  const double p_exponential = beyond_tails_alike_p_value(9.0, exponential);
  EXPECT_GT(p_exponential, 0.3 * std::exp(-9.0));
  EXPECT_LT(p_exponential, 3.0 * std::exp(-9.0));
  // Scale does not matter, nor do sizes of nothing; of few nothing is known.
  for (double& size : normal) size *= 1e-3;
  normal.push_back(0.0);
  EXPECT_NEAR(beyond_tails_alike_p_value(4.5e-3, normal), p_normal, 1e-9 * p_normal);
  EXPECT_EQ(beyond_tails_alike_p_value(9.0, {1.0, 1.0, 1.0}), 1.0);
}

/// Every place asked gives the value that sorting gives.
void expect_as_sorted(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t last = values.size() - 1;
  for (const std::size_t n :
       {std::size_t{0}, std::size_t{1}, last / 200, last / 3, last / 2, last - last / 200, last}) {
    std::vector<double> asked = values;
    EXPECT_EQ(nth_smallest(asked, n), sorted[n]) << n << " of " << values.size();
  }
}

TEST(OrderStatistics, OfManyValuesTheNthIsThatOfTheSortedOnes) {
  std::mt19937_64 random(20261127);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {4095U, 4096U, 5000U, 40000U}) {
    std::vector<double> values(count);
    for (double& value : values) value = normal(random);
    expect_as_sorted(values);
    for (double& value : values) value = std::round(2.0 * value);  // few levels
    expect_as_sorted(values);
    std::sort(values.begin(), values.end());
    expect_as_sorted(values);
    std::fill(values.begin(), values.end(), 1.0);
    expect_as_sorted(values);
  }
}

TEST(OrderStatistics, ASampleThatMisleadsDoesNotDecide) {
  // every 16th value lies elsewhere
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(i % 16 == 0 ? 1e6 + i : i % 1000);
  expect_as_sorted(values);
  EXPECT_FALSE(nth_within_bounds(values, values.size() / 2).has_value());
  for (double& value : values) value = -value;
  expect_as_sorted(values);
}

}  // namespace
}  // namespace trueflank::loop
