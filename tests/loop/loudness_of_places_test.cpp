// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/loudness.h"

namespace trueflank::loop {
namespace {

Eigen::VectorXd white_course(Eigen::Index values, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(values, [&] { return normal(random); });
}

TEST(LoudnessOfFew, TellsOneThatIsFarLouderAndNoQuietOne) {
  const std::vector<double> many{120.0, 120.0, 120.0};
  const std::vector<double> loud = loudness_of_few({1.0, 1.1, 3.0}, many).factors;
  EXPECT_EQ(loud[0], 1.0);
  EXPECT_EQ(loud[1], 1.0);
  EXPECT_NEAR(loud[2], 2.7, 0.35);
  EXPECT_EQ(loudness_of_few({1.0, 1.0, 0.3}, many).factors, (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(loudness_of_few({1.0, 1.4}, {40.0, 40.0}).factors, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(loudness_of_few({2.0}, {80.0}).factors, std::vector<double>{1.0});
}

TEST(LoudnessOfFew, IsSeldomToldOfCoursesAlike) {
  int told = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::vector<double> scatters;
    for (unsigned c = 0; c < 4; ++c)
      scatters.push_back(short_wave_scatter(white_course(80, 4 * seed + c)));
    for (const double loud : loudness_of_few(scatters, std::vector(4, 80.0)).factors)
      told += loud > 1.0 ? 1 : 0;
  }
  EXPECT_LE(told, 20);
}

/// Courses that are so many times louder behind a share of their length.
Eigen::MatrixXd louder_behind(double share, double times, Eigen::Index courses, unsigned seed) {
  constexpr Eigen::Index kPlaces = 96;
  Eigen::MatrixXd set(kPlaces, courses);
  for (Eigen::Index c = 0; c < courses; ++c)
    set.col(c) = white_course(kPlaces, 31 * seed + static_cast<unsigned>(c));
  const auto first = static_cast<Eigen::Index>(share * kPlaces);
  set.bottomRows(kPlaces - first) *= times;
  return set;
}

Eigen::VectorXd loudness_along(const Eigen::MatrixXd& set) {
  std::vector<double> scatters;
  for (Eigen::Index c = 0; c < set.cols(); ++c) scatters.push_back(short_wave_scatter(set.col(c)));
  return loudness_of_places({set}, {scatters});
}

TEST(LoudnessOfPlaces, FollowsThemAndIsOneWhereTheyAreAlike) {
  constexpr int kSets = 20;
  double behind = 0.0, before = 0.0;
  for (unsigned seed = 1; seed <= kSets; ++seed) {
    const Eigen::VectorXd loud = loudness_along(louder_behind(0.75, 3.0, 8, seed));
    behind += loud[90] / kSets;
    before = std::max(before, loud.head(60).maxCoeff());
  }
  EXPECT_NEAR(behind, 2.6, 0.4);  // (shrunk by what chance makes of it)
  EXPECT_LT(before, 1.6);
  int told = 0;
  for (unsigned seed = 1; seed <= 50; ++seed)
    told += loudness_along(louder_behind(0.5, 1.0, 4, seed)).maxCoeff() > 1.25 ? 1 : 0;
  EXPECT_LE(told, 2);
}

/// How many of these sets have a spot.
int spots_in(int sets, const std::function<std::vector<Eigen::MatrixXd>(unsigned)>& drawn) {
  int spots = 0;
  for (int seed = 1; seed <= sets; ++seed)
    for (const CourseFinding& found : scan_courses(drawn(static_cast<unsigned>(seed))))
      spots += found.kind == CourseFinding::Kind::kSpot && found.p_value < 1e-3 ? 1 : 0;
  return spots;
}

TEST(LoudnessOfPlaces, AndOfFewCoursesKeepsSpotsAway) {
  EXPECT_LE(spots_in(60,
                     [](unsigned seed) {
                       return std::vector{louder_behind(0.8, 3.0, 6, seed),
                                          louder_behind(0.8, 3.0, 6, 900 + seed)};
                     }),
            5);
  EXPECT_LE(spots_in(60,
                     [](unsigned seed) {
                       Eigen::MatrixXd left = louder_behind(0.5, 1.0, 4, seed),
                                       right = louder_behind(0.5, 1.0, 4, 900 + seed);
                       left.col(1) *= 3.0;
                       right.col(1) *= 3.0;
                       return std::vector{left, right};
                     }),
            5);
}

TEST(LoudnessOfPlaces, LeavesSpotsOfQuietPlaces) {
  EXPECT_GE(spots_in(20,
                     [](unsigned seed) {
                       Eigen::MatrixXd set = louder_behind(0.8, 3.0, 6, seed);
                       for (Eigen::Index i = 0; i < 14; ++i)
                         set(30 + i, 2) +=
                             4.0 * std::pow(std::sin(0.2 * (static_cast<double>(i) + 1.0)), 2);
                       return std::vector{set};
                     }),
            16);
}

}  // namespace
}  // namespace trueflank::loop
