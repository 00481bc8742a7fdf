// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "tests/loop/made_gears.h"

// Points of a scan that stand aside at random among the others, as where two scans that do not fit
// were laid over each other: their mean was an eccentricity, the rest of it noise.
namespace trueflank::test {
namespace {

constexpr double kNoise_um = 3.0;

/// The scan with what `aside_um` says of each of its points along the plane, towards a direction.
loop::ScanData with_points_aside(loop::ScanData scan, double towards_deg,
                                 const std::function<double(const Vec3&)>& aside_um) {
  const double towards = towards_deg * M_PI / 180.0;
  for (Vec3& p : scan.points_mm) {
    const double off_mm = 1e-3 * aside_um(p);
    p[0] += off_mm * std::cos(towards);
    p[1] += off_mm * std::sin(towards);
  }
  return scan;
}

bool says_points_aside(const loop::LoopResult& result) {
  return result.structure_left.find("of the points stand") != std::string::npos;
}

TEST(SecondPlace, OfSomeOfThePointsIsNoEccentricity) {
  std::mt19937_64 random(635);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (unsigned draw = 1; draw <= survey_size(2U, 8U); ++draw) {
    const MadeGear gear = draw % 2 == 0 ? helical(24, 15.0) : spur(21);
    const double um = (4.0 + 5.0 * uniform(random)) * kNoise_um,
                 deg = std::round(360.0 * uniform(random)), share = 0.3 + 0.2 * uniform(random);
    const auto tapered = grown([](auto&, const FlankSpot& s, auto&) { return 15.0 * s.v; });
    const auto result =
        close(gear,
              with_points_aside(scan_of(gear, {tapered}, scanned(6000, kNoise_um, draw)), deg,
                                [&](auto&) { return uniform(random) < share ? um : 0.0; }),
              true);
    SCOPED_TRACE(list(result) + " " + result.structure_left);
    EXPECT_TRUE(says_points_aside(result));
    EXPECT_EQ(find(result, "eccentricity"), nullptr);
    EXPECT_NE(find(result, "taper"), nullptr);
    EXPECT_EQ(result.verdict, loop::Verdict::kPartlyExplained);
    const std::string& left = result.structure_left;
    const double told_share = std::stod(left),
                 told_um = std::stod(left.substr(left.find("stand ") + 6)),
                 told_deg = std::stod(left.substr(left.find("towards ") + 8));
    EXPECT_NEAR(told_share, 100.0 * share, 6.0);
    EXPECT_NEAR(told_um, um, 0.1 * um);
    EXPECT_NEAR(std::remainder(told_deg - deg, 360.0), 0.0, 5.0);
    EXPECT_NEAR(result.noise, kNoise_um, 0.2 * kNoise_um);
  }
}

// Noise that is larger on walls that face one direction, long tails, a part of the gear that moved.
TEST(SecondPlace, IsNotToldOfNoiseOrOfAPartThatMoved) {
  const MadeGear gear = spur(21);
  std::mt19937_64 random(636);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::student_t_distribution<double> tails(3.0);
  for (unsigned draw = 1; draw <= survey_size(1U, 6U); ++draw) {
    const loop::ScanData scan = scan_of(gear, {}, scanned(6000, kNoise_um, draw));
    const auto of = [&](const std::function<double(const Vec3&)>& aside_um) {
      return close(gear, with_points_aside(scan, 57.0, aside_um), true);
    };
    for (const auto& result :
         {of([](auto&) { return 0.0; }),
          of([&](auto&) { return 3.0 * kNoise_um * normal(random); }),
          of([&](auto&) { return 2.0 * kNoise_um * tails(random); }),
          of([](const Vec3& p) { return p[0] > 0.0 ? 8.0 * kNoise_um : 0.0; })})
      EXPECT_FALSE(says_points_aside(result)) << list(result) << " " << result.structure_left;
  }
}

}  // namespace
}  // namespace trueflank::test
