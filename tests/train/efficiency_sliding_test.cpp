// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_sliding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

/// z1 = 20, z2 = 50, base pitch 1: contact from e1 before to e2 after the pitch point.
ContactPath path_of(bool internal, double e1, double e2) {
  ContactPath path;
  path.base_radius1_mm = 20 / kTwoPi;
  path.base_radius2_mm = 50 / kTwoPi;
  path.internal = internal;
  path.base_pitch_mm = 1.0;
  path.pitch_point_mm = path.base_radius1_mm * std::tan(0.4);
  path.start_mm = path.pitch_point_mm - e1;
  path.end_mm = path.pitch_point_mm + e2;
  return path;
}

double formula_loss(bool internal, double e1, double e2, double friction) {
  return 1 - basic_efficiency({.teeth1 = 20, .teeth2 = 50, .internal = internal, .approach = e1,
                               .recess = e2}, friction);
}

TEST(EfficiencySliding, IsTheContactRatioFormulaToFirstOrderWhereThatApplies) {
  const double friction = 1e-6;
  for (const bool internal : {false, true})
    for (const auto& [e1, e2] : {std::pair{0.8, 0.7}, {0.5, 0.5}, {1.0, 0.3}, {0.2, 0.9}}) {
      const SlidingEfficiency s =
          sliding_efficiency(path_of(internal, e1, e2), friction, LoadSharing::kEqual);
      const double loss = formula_loss(internal, e1, e2, friction);
      EXPECT_NEAR((1 - s.gear1_driving) / loss, 1.0, 1e-4);
      EXPECT_NEAR((1 - s.gear2_driving) / loss, 1.0, 1e-4);
    }
}

TEST(EfficiencySliding, DiffersFromTheFormulaWherePitchPointHasNoSingleContact) {
  // all recess, e1 < 0: one pair or two, always past the pitch point. Equal shares: the loss is
  // mu 2 pi (1/z1 + 1/z2) times the mean distance, 1/2 int_E + 1/2 int_single |s| ds
  const double friction = 1e-6, e1 = -0.2, e2 = 1.4;
  const double mean = 0.25 * (e2 * e2 - e1 * e1) + 0.25 * ((1 - e1) * (1 - e1) - (e2 - 1) * (e2 - 1));
  const double expected = friction * kTwoPi * (1 / 20. + 1 / 50.) * mean;
  const SlidingEfficiency s =
      sliding_efficiency(path_of(false, e1, e2), friction, LoadSharing::kEqual);
  EXPECT_NEAR((1 - s.gear1_driving) / expected, 1.0, 1e-6);
  EXPECT_GT(std::abs(formula_loss(false, e1, e2, friction) / expected - 1.0), 0.02);
}

TEST(EfficiencySliding, AgreesWithABruteForceSumOfForces) {
  const double friction = 0.15;
  for (const bool internal : {false, true}) {
    const ContactPath path = path_of(internal, 0.75, 0.85);
    // gear 1 drives at constant torque 1 on gear 2; 200000 moments, midpoint rule
    const int moments = 200000;
    double work_in = 0.0;
    for (int i = 0; i < moments; ++i) {
      double t1 = 0, t2 = 0;
      for (double roll = path.start_mm + (i + 0.5) / moments; roll <= path.end_mm; roll += 1.0) {
        const double mu = roll < path.pitch_point_mm ? -friction : friction;
        const double along2 = path.pitch_point_mm * 2.5 +
                              (internal ? 1 : -1) * (roll - path.pitch_point_mm);
        t1 += path.base_radius1_mm + mu * roll;
        t2 += path.base_radius2_mm + mu * along2;
      }
      work_in += t1 / t2 / moments;
    }
    EXPECT_NEAR(sliding_efficiency(path, friction, LoadSharing::kEqual).gear1_driving,
                0.4 / work_in, 2e-6);
  }
}

TEST(EfficiencySliding, CompliantPairsLoseLessBecauseMidContactCarriesMore) {
  const ContactPath path = path_of(false, 0.8, 0.8);
  EXPECT_GT(sliding_efficiency(path, 0.1, LoadSharing::kCompliant).gear1_driving,
            sliding_efficiency(path, 0.1, LoadSharing::kEqual).gear1_driving);
}

TEST(EfficiencySliding, AWholeNumberOfOverlapsAveragesThePath) {
  // equal load per length of contact line, always the same total length: loss = mean of |s|
  ContactPath path = path_of(false, 0.8, 0.6);
  path.overlap_ratio = 1.0;
  path.base_helix_angle_rad = 0.2;
  const double friction = 1e-6;
  const double mean = (0.8 * 0.8 + 0.6 * 0.6) / 2 / 1.4;
  const double expected = friction / std::cos(0.2) * kTwoPi * (1 / 20. + 1 / 50.) * mean;
  const SlidingEfficiency s = sliding_efficiency(path, friction, LoadSharing::kEqual);
  EXPECT_NEAR((1 - s.gear1_driving) / expected, 1.0, 1e-6);
}

TEST(EfficiencySliding, HelicalTeethAreEveryMomentTheSumOverTheFace) {
  // prefix sums over a fine grid of the cycle; overlaps are whole numbers of its steps
  constexpr int kSteps = 100000;
  for (const double overlap : {0.03, 0.37, 0.71, 1.0, 1.6, 2.25})
    for (const bool internal : {false, true}) {
      ContactPath path = path_of(internal, 0.55, 0.72);
      path.overlap_ratio = overlap;
      path.base_helix_angle_rad = 0.3;
      const double friction = 0.12, transverse = friction / std::cos(0.3);
      const double middle = 0.5 * (path.start_mm + path.end_mm),
                   half = 0.5 * (path.end_mm - path.start_mm);
      std::vector<double> sums1{0.0}, sums2{0.0};
      for (int i = 0; i < 4 * kSteps; ++i) {
        double t1 = 0.0, t2 = 0.0;
        for (double roll = path.start_mm + (i % kSteps + 0.5) / kSteps; roll <= path.end_mm;
             roll += 1.0) {
          const double s = roll - path.pitch_point_mm, mu = s < 0.0 ? -transverse : transverse;
          const double stiff = 1.0 - 0.3 * (roll - middle) * (roll - middle) / (half * half);
          t1 += stiff * (path.base_radius1_mm + mu * roll);
          t2 += stiff * (path.base_radius2_mm +
                         mu * (path.pitch_point_mm * path.base_radius2_mm / path.base_radius1_mm +
                               (internal ? s : -s)));
        }
        sums1.push_back(sums1.back() + t1);
        sums2.push_back(sums2.back() + t2);
      }
      const auto across = static_cast<std::size_t>(std::lround(overlap * kSteps));
      double mean = 0.0;
      for (std::size_t i = 0; i < kSteps; ++i)
        mean += (sums1[i + across] - sums1[i]) / (sums2[i + across] - sums2[i]) / kSteps;
      EXPECT_NEAR(sliding_efficiency(path, friction, LoadSharing::kCompliant).gear1_driving,
                  path.base_radius1_mm / path.base_radius2_mm / mean, 1e-7)
          << overlap << (internal ? " internal" : "");
    }
}

TEST(EfficiencySliding, ExtremeFrictionBlocksAndInterruptedContactIsNotComputed) {
  EXPECT_EQ(sliding_efficiency(path_of(false, 0.9, 0.9), 3.0, LoadSharing::kEqual).gear1_driving,
            0.0);
  EXPECT_TRUE(std::isnan(
      sliding_efficiency(path_of(false, 0.4, 0.5), 0.1, LoadSharing::kEqual).gear1_driving));
}

TEST(EfficiencySliding, NothingIsLostWithoutFriction) {
  const SlidingEfficiency s =
      sliding_efficiency(path_of(true, 0.8, 0.7), 0.0, LoadSharing::kEqual);
  EXPECT_NEAR(s.gear1_driving, 1.0, 1e-14);
  EXPECT_NEAR(s.gear2_driving, 1.0, 1e-14);
}

}  // namespace
}  // namespace trueflank
