// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/ring_scan.h"

// What is looked for in remainders, on made values: found where it is, and seldom where nothing is.
namespace trueflank::loop {
namespace {

using Eigen::MatrixXd;
using Kind = CourseFinding::Kind;

/// Courses of errors that hang together by rho from one place to the next.
MatrixXd errors(int places, int courses, double rho, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd m(places, courses);
  for (int c = 0; c < courses; ++c) {
    double now = normal(random);
    for (int i = 0; i < places; ++i) {
      now = rho * now + std::sqrt(1.0 - rho * rho) * normal(random);
      m(i, c) = now;
    }
  }
  return m;
}

MatrixXd centred(MatrixXd m) {
  m.rowwise() -= m.colwise().mean().eval();
  return m;
}

template <class Function>
MatrixXd with(MatrixXd m, Function form) {
  for (Eigen::Index c = 0; c < m.cols(); ++c)
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      m(i, c) += form((static_cast<double>(i) + 0.5) / static_cast<double>(m.rows()), c);
  return centred(std::move(m));
}

const CourseFinding* find(const std::vector<CourseFinding>& found, Kind kind) {
  for (const CourseFinding& f : found)
    if (f.kind == kind && f.p_value < 1e-3) return &f;
  return nullptr;
}

TEST(CourseScan, SeldomAlarmsOnErrorsThatHangTogether) {
  for (const double rho : {0.0, 0.7}) {
    int alarms = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
      const auto found = scan_courses(
          {centred(errors(80, 8, rho, seed)), centred(errors(80, 8, rho, 1000 + seed))});
      alarms +=
          std::any_of(found.begin(), found.end(), [](const auto& f) { return f.p_value < 0.01; });
    }
    // Three questions at 1 %: nine or more of 100 come once in 300 such tests.
    EXPECT_LE(alarms, 8) << rho;
  }
}

/// What a gauge's filter makes of white errors: weights over neighbouring values.
MatrixXd filtered(Eigen::Index places, int courses, const std::vector<double>& weights,
                  unsigned seed) {
  const auto taps = static_cast<Eigen::Index>(weights.size());
  const MatrixXd white = errors(static_cast<int>(places + taps) - 1, courses, 0.0, seed);
  MatrixXd out = MatrixXd::Zero(places, courses);
  for (Eigen::Index k = 0; k < taps; ++k)
    out += weights[static_cast<std::size_t>(k)] * white.middleRows(k, places);
  return centred(out);
}

TEST(CourseScan, WhatAGaugesFilterTookAwayIsNoWave) {
  const std::vector<std::vector<double>> filters{
      {0.25, 0.5, 0.25}, {0.2, 0.2, 0.2, 0.2, 0.2}, {0.02, 0.09, 0.23, 0.32, 0.23, 0.09, 0.02}};
  for (const auto& filter : filters) {
    int alarms = 0;
    for (unsigned seed = 1; seed <= 30; ++seed)
      for (const Eigen::Index places : {48, 80}) {
        const auto found = scan_courses(
            {filtered(places, 12, filter, seed), filtered(places, 12, filter, 1000 + seed)});
        alarms +=
            std::any_of(found.begin(), found.end(), [](const auto& f) { return f.p_value < 0.01; });
      }
    // Three questions at 1 % of 60: six or more come once in 100 such tests.
    EXPECT_LE(alarms, 5) << filter.size() << " weights";
  }
}

TEST(CourseScan, FindsAGrooveAStepAndWavesWhereTheyAre) {
  const MatrixXd right = centred(errors(80, 6, 0.5, 2));
  const auto groove = scan_courses(
      {with(errors(80, 6, 0.5, 1),
            [](double x, auto) { return -4.0 * std::exp(-std::pow((x - 0.3) / 0.05, 2)); }),
       right});
  const CourseFinding* found = find(groove, Kind::kBand);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->set, 0);
  EXPECT_NEAR(found->at, 0.3, 0.02);
  EXPECT_NEAR(found->amount, -4.0, 1.0);

  const auto step = scan_courses(
      {with(errors(80, 6, 0.5, 1), [](double x, auto) { return x > 0.6 ? 3.0 : 0.0; }), right});
  ASSERT_NE(find(step, Kind::kStep), nullptr);
  EXPECT_NEAR(find(step, Kind::kStep)->at, 0.6, 0.02);

  const auto bent = scan_courses(
      {with(errors(80, 6, 0.5, 1),
            [](double x, auto) { return 5.0 * x + 12.0 * std::max(0.0, x - 0.7); }),
       right});
  const CourseFinding* kink = find(bent, Kind::kKink);
  ASSERT_NE(kink, nullptr);
  EXPECT_EQ(kink->set, 0);
  EXPECT_NEAR(kink->at, 0.7, 0.06);
  EXPECT_NEAR(kink->before, 5.0, 1.5);
  EXPECT_NEAR(kink->beyond, 17.0, 4.0);

  const auto waves = scan_courses(
      {with(errors(80, 6, 0.5, 1), [](double x, auto) { return 2.0 * std::sin(60.0 * x); }),
       right});
  ASSERT_NE(find(waves, Kind::kWave), nullptr);
  EXPECT_NEAR(find(waves, Kind::kWave)->width, 2.0 * M_PI / 60.0, 0.002);
  EXPECT_NEAR(find(waves, Kind::kWave)->amount, 2.0, 0.4);
}

TEST(CourseScan, WavesInAPhaseOfTheirOwnAreFoundThoughTheMeanHasNone) {
  const auto found = scan_courses({with(errors(80, 8, 0.5, 1), [](double x, auto c) {
    return 2.0 * std::sin(2.0 * M_PI * 12.0 * x + 2.4 * static_cast<double>(c));
  })});
  const CourseFinding* own = find(found, Kind::kOwnWaves);
  ASSERT_NE(own, nullptr);
  EXPECT_NEAR(own->width, 1.0 / 12.0, 0.005);
  EXPECT_NEAR(own->amount, 2.0, 0.4);
}

TEST(CourseScan, ADeepHollowOverHalfOfOneCourseIsFound) {
  const auto deep = [](double x, auto c) {
    const double off = (x - 0.55) / 0.28;
    return c == 17 ? -29.0 * std::max(0.0, 1.0 - off * off) : 0.0;
  };
  const auto found =
      scan_courses({with(errors(120, 19, 0.0, 1), deep), centred(errors(120, 19, 0.0, 2))});
  ASSERT_NE(find(found, Kind::kSpot), nullptr);
  EXPECT_EQ(find(found, Kind::kSpot)->course, 17);
}

TEST(CourseScan, OneCourseOfLouderErrorsHasNoWavesOfItsOwn) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    MatrixXd courses = errors(120, 11, 0.0, seed);
    courses.col(3) *= 5.0;
    alarms += find(scan_courses({centred(courses)}), Kind::kOwnWaves) != nullptr;
  }
  EXPECT_LE(alarms, 1);
}

TEST(CourseScan, ASpotOnOneCourseIsFoundThereAndAWildPointIsNone) {
  const auto spot = scan_courses({with(errors(80, 8, 0.0, 1), [](double x, auto c) {
    return c == 5 && std::abs(x - 0.7) < 0.06 ? 8.0 : 0.0;
  })});
  const CourseFinding* found = find(spot, Kind::kSpot);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->course, 5);
  EXPECT_NEAR(found->at, 0.7, 0.04);
  const auto wild = scan_courses({with(errors(80, 8, 0.0, 1), [](double x, auto c) {
    return c == 5 && std::abs(x - 0.7) < 0.006 ? 30.0 : 0.0;
  })});
  EXPECT_EQ(find(wild, Kind::kSpot), nullptr);
}

// Dust under the probe: a bump of a few places on one of four traces. Errors from place to place
// are nearly free of each other, so windows of them have no long tails.
TEST(CourseScan, ASmoothSpotOnOneOfFewCoursesIsFound) {
  const auto bump = [](double x, auto c) {
    const double off = (x - 0.42) / 0.045;
    return c == 2 ? 5.5 * std::exp(-off * off) : 0.0;
  };
  int found = 0, alarms = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const MatrixXd other = centred(errors(57, 4, 0.2, 100 + seed));
    const auto of_bump = scan_courses({with(errors(57, 4, 0.2, seed), bump), other});
    const CourseFinding* spot = find(of_bump, Kind::kSpot);
    found += spot != nullptr && spot->set == 0 && spot->course == 2;
    alarms +=
        find(scan_courses({centred(errors(57, 4, 0.2, seed)), other}), Kind::kSpot) != nullptr;
  }
  EXPECT_GE(found, 26);
  EXPECT_LE(alarms, 1);
}

TEST(CourseScan, ACourseOfLouderErrorsHasNoSpots) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    MatrixXd courses = errors(100, 24, 0.5, seed);
    courses.col(7) *= 4.0;
    alarms += find(scan_courses({centred(courses)}), Kind::kSpot) != nullptr;
  }
  EXPECT_LE(alarms, 1);
}

std::vector<int> all_places(int n) {
  std::vector<int> place(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(i)] = i;
  return place;
}

TEST(RingScan, SeldomAlarms) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 200; ++seed)
    alarms += scan_ring(errors(24, 4, 0.0, seed), all_places(24), 24).p_value < 0.01;
  // At 1 % seven or more of 200 come once in 200 such tests.
  EXPECT_LE(alarms, 6);
}

TEST(RingScan, SaysTheSameOfALevelWhereverItsAnswerIsYes) {
  int yes = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const double size = 0.25 * static_cast<double>(seed % 8);
    const auto series = with(errors(24, 3, 0.0, seed), [&](double x, auto) { return x < 0.3 ? size : 0.0; });
    const RingFinding whole = scan_ring(series, all_places(24), 24);
    for (const double level : {0.2, 0.02, 0.004}) {
      const RingFinding asked = scan_ring(series, all_places(24), 24, level);
      ASSERT_EQ(asked.p_value <= level, whole.p_value <= level) << seed;
      if (asked.p_value > level) continue;
      ++yes;
      EXPECT_EQ(asked.p_value, whole.p_value);
      EXPECT_EQ(asked.kind, whole.kind);
      EXPECT_EQ(asked.first, whole.first);
      EXPECT_EQ(asked.count, whole.count);
    }
  }
  EXPECT_GT(yes, 20);
}

TEST(RingScan, SeldomAlarmsWhereEightTeethOfManyWereTraced) {
  int alarms = 0;
  for (const int ring : {33, 47, 62}) {
    std::vector<int> places;
    for (int i = 0; i < 8; ++i) places.push_back(static_cast<int>(std::lround(i * ring / 8.0)) % ring);
    for (unsigned seed = 1; seed <= 100; ++seed)
      alarms += scan_ring(errors(8, 4, 0.0, seed), places, ring).p_value < 1e-3;
  }
  // At 0.1 % four or more of 300 come once in 3000 such tests.
  EXPECT_LE(alarms, 3);
}

TEST(RingScan, FindsASectorAndEveryOtherTooth) {
  const auto sector = scan_ring(
      with(errors(24, 1, 0.0, 1), [](double x, auto) { return x > 0.8 || x < 0.05 ? 6.0 : 0.0; }),
      all_places(24), 24);
  EXPECT_LT(sector.p_value, 1e-3);
  EXPECT_EQ(sector.first, 19);
  EXPECT_EQ(sector.count, 6);
  EXPECT_NEAR(sector.amount, 6.0, 1.0);
  const auto other = scan_ring(
      with(errors(24, 1, 0.0, 1),
           [](double x, auto) { return std::lround(24.0 * x - 0.5) % 2 == 0 ? 3.0 : -3.0; }),
      all_places(24), 24);
  EXPECT_LT(other.p_value, 1e-3);
  EXPECT_EQ(other.kind, RingFinding::Kind::kComb);
  EXPECT_EQ(other.count, 2);
}

TEST(RingScan, FindsARampThatBeginsAnewAndOneToothInThree) {
  const auto ramp = scan_ring(with(errors(29, 1, 0.0, 1),
                                   [](double x, auto) {
                                     const long place = std::lround(29.0 * x - 0.5);
                                     return 8.0 * static_cast<double>((place + 24) % 29) / 29.0;
                                   }),
                              all_places(29), 29);
  EXPECT_LT(ramp.p_value, 1e-3);
  EXPECT_EQ(ramp.kind, RingFinding::Kind::kRamp);
  EXPECT_EQ(ramp.first, 5);
  EXPECT_NEAR(ramp.amount, 8.0, 2.0);
  const auto comb = scan_ring(
      with(errors(24, 1, 0.0, 1),
           [](double x, auto) { return std::lround(24.0 * x - 0.5) % 3 == 1 ? 5.0 : 0.0; }),
      all_places(24), 24);
  EXPECT_LT(comb.p_value, 1e-3);
  EXPECT_EQ(comb.kind, RingFinding::Kind::kComb);
  EXPECT_EQ(comb.count, 3);
  EXPECT_EQ(comb.first, 1);
  EXPECT_NEAR(comb.amount, 5.0, 1.0);
}

TEST(RingScan, ASectorOfFewTeethIsFoundThoughFewOrdersExist) {
  const auto found =
      scan_ring(with(errors(9, 1, 0.0, 3), [](double x, auto) { return x < 0.45 ? 40.0 : 0.0; }),
                all_places(9), 9);
  EXPECT_LT(found.p_value, 1e-3);
  EXPECT_EQ(found.count, 4);
}

}  // namespace
}  // namespace trueflank::loop
