// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/course_waves.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using loop::CourseFinding;
using Sets = std::vector<MatrixXd>;

/// Squared amplitude of so many waves on a course, through a window that falls to nothing at its
/// ends.
double squared_amplitude(const VectorXd& course, Index waves) {
  std::complex<double> sum = 0.0;
  const auto m = static_cast<double>(course.size());
  for (Index i = 0; i < course.size(); ++i) {
    const double turn = kTwoPi * (static_cast<double>(i) + 0.5) / m;
    sum += course[i] * (1.0 - std::cos(turn)) * std::polar(1.0, static_cast<double>(waves) * turn);
  }
  return 4.0 * std::norm(sum / m);
}

/// What the header says, wavelength by wavelength.
CourseFinding waves_by_hand(const Sets& sets, const std::vector<VectorXd>& loud, double& tests) {
  CourseFinding best{CourseFinding::Kind::kOwnWaves};
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto courses = static_cast<double>(sets[s].cols());
    std::vector<double> power;  // mean over courses of one loudness
    for (Index k = 0; k < sets[s].rows() / 2; ++k) {
      power.push_back(0.0);
      for (Index c = 0; c < sets[s].cols() && k > 0; ++c)
        power.back() += squared_amplitude(sets[s].col(c), k) / std::pow(loud[s][c], 2) / courses;
    }
    double usual = 0.0;
    for (std::size_t k = 2; k < power.size(); ++k)
      usual += power[k] / static_cast<double>(power.size() - 2);
    for (std::size_t k = 5; k + 4 < power.size() && sets[s].cols() > 0; ++k) {
      tests += 1.0;
      const double below = power[k - 4] * power[k - 3], above = power[k + 3] * power[k + 4];
      const double ratio = power[k] / std::pow(below * above, 0.25);
      const double p = loop::f_tail(ratio, 2.0 * courses, 6.0 * courses);
      if (power[k] < usual || power[k] < 1.5 * std::sqrt(std::max(below, above)) || ratio < 3.0 ||
          p >= best.p_value)
        continue;
      best.p_value = p;
      best.set = static_cast<int>(s);
      best.width = 1.0 / static_cast<double>(k);
      best.amount = std::sqrt(power[k] * loud[s].squaredNorm() / courses);
    }
  }
  if (best.set < 0) return best;
  const MatrixXd& set = sets[static_cast<std::size_t>(best.set)];
  std::vector<double> own;
  double all = 0.0, held = 0.0;
  for (Index c = 0; c < set.cols(); ++c) {
    own.push_back(squared_amplitude(set.col(c), std::lround(1.0 / best.width)));
    all += own.back();
  }
  std::vector<double> sorted = own;
  std::sort(sorted.begin(), sorted.end());
  // the median of an exponential distribution is ln 2 of its mean
  const double usual = sorted[sorted.size() / 2] / std::log(2.0);
  std::vector<int> holders;
  for (std::size_t c = 0; c < own.size(); ++c) {
    if (own[c] < 8.0 * usual) continue;
    holders.push_back(static_cast<int>(c));
    held += own[c];
  }
  if (held < 0.7 * all || 3 * holders.size() > own.size()) return best;
  best.amount = std::sqrt(held / static_cast<double>(holders.size()));
  best.holders = holders;
  return best;
}

TEST(OwnWaves, AreTheWavelengthThatStandsOutMost) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(0.0, 1.0);
  int told = 0, with_holders = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const Index places = 40 + 9 * (trial % 8);
    Sets sets;
    std::vector<VectorXd> loud;
    for (int s = 0; s < 1 + trial % 3; ++s) {
      const Index courses = trial % 7 == 0 && s == 1 ? 0 : 1 + (5 * trial + 3 * s) % 12;
      sets.push_back(MatrixXd::NullaryExpr(places, courses, [&] { return normal(random); }));
      loud.push_back(VectorXd::NullaryExpr(courses, [&] { return 0.5 + any(random); }));
      if (trial % 4 == 3 || s != trial % 2) continue;
      const double waves = 3.0 + any(random) * 0.4 * static_cast<double>(places);
      const double height = 0.3 + 2.0 * any(random);
      const Index holders = trial % 4 == 0 ? std::max<Index>(1, courses / 4) : courses;
      for (Index c = 0; c < holders; ++c) {
        const double phase = kTwoPi * any(random);
        for (Index i = 0; i < places; ++i)
          sets.back()(i, c) += (trial % 4 == 0 ? 3.0 : 1.0) * height *
                               std::cos(kTwoPi * waves * (static_cast<double>(i) + 0.5) /
                                            static_cast<double>(places) +
                                        phase);
      }
    }
    double tests = 0.0, known_tests = 0.0;
    const CourseFinding found = loop::own_waves(sets, loud, tests),
                        known = waves_by_hand(sets, loud, known_tests);
    EXPECT_EQ(tests, known_tests) << trial;
    EXPECT_EQ(found.kind, CourseFinding::Kind::kOwnWaves);
    ASSERT_EQ(found.set, known.set) << trial;
    EXPECT_DOUBLE_EQ(found.width, known.width) << trial;
    EXPECT_NEAR(found.p_value, known.p_value, 1e-9 * known.p_value) << trial;
    EXPECT_NEAR(found.amount, known.amount, 1e-9 * known.amount) << trial;
    EXPECT_EQ(found.holders, known.holders) << trial;
    told += found.set >= 0 ? 1 : 0;
    with_holders += found.holders.empty() ? 0 : 1;
  }
  EXPECT_GT(told, 40);
  EXPECT_GT(with_holders, 5);
}

}  // namespace
}  // namespace trueflank::test
