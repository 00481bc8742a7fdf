// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/loudness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trueflank::loop {
namespace {

Eigen::VectorXd white(Eigen::Index values, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(values, [&] { return normal(random); });
}

Loudness loudness_of_courses(const std::vector<Eigen::VectorXd>& courses) {
  std::vector<double> scatters, values;
  for (const Eigen::VectorXd& course : courses) {
    scatters.push_back(short_wave_scatter(course));
    values.push_back(static_cast<double>(course.size()));
  }
  return loudness_of(scatters, values);
}

TEST(Loudness, OfCoursesAlikeIsNearOne) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<Eigen::VectorXd> courses;
    for (unsigned c = 0; c < 20; ++c) courses.push_back(white(80, 100 * seed + c));
    for (const double loud : loudness_of_courses(courses).factors) EXPECT_NEAR(loud, 1.0, 0.35);
  }
}

TEST(Loudness, OfOneLoudCourseIsNearlyWhatItIsAndTheOthersAreNot) {
  std::vector<Eigen::VectorXd> courses;
  for (unsigned c = 0; c < 20; ++c) courses.push_back(white(200, 7 + c));
  courses[4] *= 4.0;
  const std::vector<double> loud = loudness_of_courses(courses).factors;
  for (std::size_t c = 0; c < loud.size(); ++c)
    EXPECT_NEAR(loud[c], c == 4 ? 4.0 : 1.0, c == 4 ? 0.8 : 0.35);
}

TEST(Loudness, OfCoursesThatAllDifferFollowsThem) {
  std::vector<Eigen::VectorXd> courses;
  std::vector<double> truth;
  for (unsigned c = 0; c < 20; ++c) {
    truth.push_back(std::exp(0.1 * static_cast<double>(c) - 0.95));
    courses.push_back(truth.back() * white(80, 40 + c));
  }
  const std::vector<double> loud = loudness_of_courses(courses).factors;
  for (std::size_t c = 0; c < loud.size(); ++c)
    EXPECT_NEAR(std::log(loud[c] / truth[c]), 0.0, 0.45) << c;
}

TEST(Loudness, HardlyKnowsAStepASpotOrAWave) {
  const Eigen::VectorXd quiet = white(80, 3);
  const double scatter = short_wave_scatter(quiet);
  Eigen::VectorXd step = quiet, spot = quiet, wave = quiet;
  step.tail(30).array() += 15.0;
  spot.segment(20, 12).array() -= 20.0;
  for (Eigen::Index i = 0; i < wave.size(); ++i)
    wave[i] += 6.0 * std::sin(1.1 * static_cast<double>(i));
  for (const Eigen::VectorXd& course : {step, spot, wave})
    EXPECT_LT(short_wave_scatter(course), 1.4 * scatter);
}

TEST(Loudness, OfTooFewIsNotAsked) {
  EXPECT_EQ(short_wave_scatter(white(11, 1)), 0.0);
  Eigen::VectorXd on_one_level = Eigen::VectorXd::Constant(80, 0.1 + 0.2);
  on_one_level[40] = 1.5;
  on_one_level.array() -= on_one_level.mean();
  EXPECT_EQ(short_wave_scatter(on_one_level), 0.0);
  EXPECT_EQ(loudness_of({1.0, 1.0, 9.0}, {80.0, 80.0, 80.0}).factors,
            (std::vector<double>{1.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace trueflank::loop
