// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

// The paper: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403.
namespace trueflank {
namespace {

constexpr std::size_t at(Member member) { return static_cast<std::size_t>(member); }

BalanceTrain train_3k(OutputMember output, const std::vector<int>& teeth, double n_a, double n_b,
                      double n_c) {
  BalanceTrain train = balance_train(TrainKind::k3k, output, teeth);
  const double n[] = {n_a, n_b, n_c};
  for (std::size_t k = 0; k < 3; ++k)
    train.meshes[k].efficiency_driving1 = train.meshes[k].efficiency_driving2 = n[k];
  return train;
}

/// The paper's general expression eta_x = G (1 + I1 ka kb) / (1 - I2 kb / kc), type I; printed
/// cases for I2 < 1 and I2 > 1, backward with every k inverted.
double paper_type1(const std::vector<int>& z, double n_a, double n_b, double n_c, bool forward) {
  const double i1 = double(z[2]) / z[0], i2 = double(z[2]) * z[3] / (double(z[1]) * z[4]);
  double ka = n_a, kb = i2 < 1 ? n_b : 1 / n_b, kc = i2 < 1 ? 1 / n_c : n_c;
  if (!forward) ka = 1 / ka, kb = 1 / kb, kc = 1 / kc;
  const double eta = (1 - i2) / (1 + i1) * (1 + i1 * ka * kb) / (1 - i2 * kb / kc);
  return forward ? eta : 1 / eta;
}

std::vector<int> random_teeth(std::mt19937& random) {
  std::uniform_int_distribution<int> sun(6, 40), planet(8, 50), change(-6, 6);
  const int z_s = sun(random), z_p = planet(random), z_p2 = std::max(6, planet(random));
  return {z_s, z_p, z_s + 2 * z_p, z_p2, z_s + z_p + z_p2 + change(random)};
}

TEST(EfficiencyBalance, PrototypeRatioIsThatOfThePaper) {
  // paper: 1/96.2, recomputed there as 96.2419
  const Speeds w = member_speeds(train_3k(OutputMember::kRing2, {12, 39, 90, 32, 81}, 1, 1, 1));
  EXPECT_NEAR(w[at(Member::kSun)] / w[at(Member::kRing2)], 96.2419, 5e-5);
  EXPECT_DOUBLE_EQ(w[at(Member::kCarrier)], 12.0 / 102.0);
  EXPECT_EQ(w[at(Member::kRing1)], 0.0);
}

TEST(EfficiencyBalance, EqualLayersStandExactlyStill) {
  const Speeds w = member_speeds(train_3k(OutputMember::kRing2, {12, 30, 72, 35, 84}, 1, 1, 1));
  EXPECT_EQ(w[at(Member::kRing2)], 0.0);
  EXPECT_TRUE(solve_balance(train_3k(OutputMember::kRing2, {12, 30, 72, 35, 84}, 1, 1, 1),
                            DriveDirection::kForward)
                  .self_locking);
}

TEST(EfficiencyBalance, AgreesWithTheGeneralExpressionForBothSignsAndDirections) {
  std::mt19937 random(20191014);
  std::uniform_real_distribution<double> loss(0.0, 0.03);
  int same = 0, opposite = 0, locked = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<int> z = random_teeth(random);
    if (z[2] * z[3] == z[1] * z[4] || z[4] <= z[3]) continue;
    const double a = 1 - loss(random), b = 1 - loss(random), c = 1 - loss(random);
    const BalanceTrain train = train_3k(OutputMember::kRing2, z, a, b, c);
    (z[2] * z[3] < z[1] * z[4] ? same : opposite)++;
    for (const bool forward : {true, false}) {
      const double expected = paper_type1(z, a, b, c, forward);
      const BalanceState state =
          solve_balance(train, forward ? DriveDirection::kForward : DriveDirection::kBackward);
      // backward: 1 / eta_x is an efficiency only where the loss directions it assumes hold
      const bool runs = forward || (expected > 0 && expected < 1);
      locked += !runs;
      ASSERT_EQ(state.self_locking, !runs) << z[0] << ' ' << z[1] << ' ' << z[2] << ' ' << z[3]
                                           << ' ' << z[4] << " expected " << expected;
      if (runs) {
        ASSERT_NEAR(state.efficiency, expected, 1e-11);
      }
    }
  }
  EXPECT_GT(same, 300);
  EXPECT_GT(opposite, 300);
  EXPECT_GT(locked, 50);
}

TEST(EfficiencyBalance, NeverHasTwoStatesThatDeliverPower) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> loss(0.0, 0.2);
  for (int i = 0; i < 2000; ++i) {
    const std::vector<int> z = random_teeth(random);
    if (z[2] * z[3] == z[1] * z[4] || z[4] <= z[3]) continue;
    for (const OutputMember output : {OutputMember::kRing2, OutputMember::kRing1})
      for (const DriveDirection direction : {DriveDirection::kForward, DriveDirection::kBackward})
        ASSERT_LE(count_delivering_states(
                      train_3k(output, z, 1 - loss(random), 1 - loss(random), 1 - loss(random)),
                      direction),
                  1);
  }
}

TEST(EfficiencyBalance, ReproducesTheTableOfMeasuredEfficiencies) {
  // one loss per mesh that explains a forward efficiency, and the backward one that follows
  // (closed form with equal losses; 12/39/90/32/81)
  const std::vector<int> z{12, 39, 90, 32, 81};
  const struct { double loss, forward, backward; } rows[] = {
      {0.00548, 0.890, 0.877}, {0.00657, 0.871, 0.853}, {0.0200, 0.685, 0.554}};
  for (const auto& row : rows) {
    const double n = 1 - row.loss;
    const BalanceTrain train = train_3k(OutputMember::kRing2, z, n, n, n);
    EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, row.forward, 6e-4);
    EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency, row.backward, 6e-4);
  }
  // ring power 11.2 and 10.3 times the power that goes through
  const BalanceState ideal =
      solve_balance(train_3k(OutputMember::kRing2, z, 1, 1, 1), DriveDirection::kForward);
  EXPECT_NEAR(ideal.meshes[1].rolling_power, 11.2, 0.05);
  EXPECT_NEAR(ideal.meshes[2].rolling_power, 10.3, 0.05);
  EXPECT_TRUE(ideal.meshes[0].gear1_drives);   // S drives P1
  EXPECT_TRUE(ideal.meshes[1].gear1_drives);   // I2 < 1: P1 drives R1
  EXPECT_FALSE(ideal.meshes[2].gear1_drives);  // and R2 drives P2
}

TEST(EfficiencyBalance, PowerInIsPowerOutAndLossesInEveryKindAndDirection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> loss(0.001, 0.02);
  const struct { TrainKind kind; OutputMember output; std::vector<int> teeth; } cases[] = {
      {TrainKind::k3k, OutputMember::kRing2, {12, 39, 90, 32, 81}},
      {TrainKind::k3k, OutputMember::kRing1, {12, 39, 90, 32, 81}},
      {TrainKind::k3k, OutputMember::kRing2, {12, 30, 72, 34, 78}},
      {TrainKind::k3k, OutputMember::kRing1, {12, 30, 72, 34, 78}},
      {TrainKind::kSimple, OutputMember::kCarrier, {12, 30, 72}},
      {TrainKind::kSimple, OutputMember::kRing, {12, 30, 72}},
      {TrainKind::kPair, OutputMember::kWheel, {17, 51}}};
  for (const auto& c : cases) {
    BalanceTrain train = balance_train(c.kind, c.output, c.teeth);
    for (BalanceMesh& mesh : train.meshes) {
      mesh.efficiency_driving1 = 1 - loss(random);
      mesh.efficiency_driving2 = 1 - loss(random);
    }
    for (const DriveDirection direction : {DriveDirection::kForward, DriveDirection::kBackward}) {
      const BalanceState state = solve_balance(train, direction);
      ASSERT_FALSE(state.self_locking);
      double power = 0.0, torque = 0.0, losses = 0.0;
      for (const double p : state.power) power += p;
      for (const double t : state.torque) torque += t;
      for (const auto& mesh : state.meshes) {
        EXPECT_GT(mesh.loss, 0.0);
        losses += mesh.loss;
      }
      EXPECT_NEAR(power, losses, 1e-12);
      EXPECT_NEAR(1.0 - state.efficiency, losses, 1e-12);
      EXPECT_NEAR(torque, 0.0, 1e-9);  // external torques balance about the central axis
    }
  }
}

TEST(EfficiencyBalance, SimpleSetsFollowTheKnownFormulas) {
  // ring fixed, carrier out: eta = (1 + n_a n_b i0) / (1 + i0) with i0 = z_r / z_s; ring out: n_a n_b
  BalanceTrain train = balance_train(TrainKind::kSimple, OutputMember::kCarrier, {12, 30, 72});
  train.meshes[0].efficiency_driving1 = train.meshes[0].efficiency_driving2 = 0.98;
  train.meshes[1].efficiency_driving1 = train.meshes[1].efficiency_driving2 = 0.99;
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency,
              (1 + 0.98 * 0.99 * 6) / 7, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency,
              7 / (1 + 6 / (0.98 * 0.99)), 1e-12);
  train.output = Member::kRing1;
  train.fixed = Member::kCarrier;
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, 0.98 * 0.99, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency, 0.98 * 0.99, 1e-12);
}

TEST(EfficiencyBalance, AMeshThatPassesNoPowerLocksTheTrain) {
  BalanceTrain train = train_3k(OutputMember::kRing2, {12, 39, 90, 32, 81}, -0.1, 0.99, 0.99);
  EXPECT_TRUE(solve_balance(train, DriveDirection::kForward).self_locking);
  EXPECT_EQ(solve_balance(train, DriveDirection::kForward).efficiency, 0.0);
}

}  // namespace
}  // namespace trueflank
