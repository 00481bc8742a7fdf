// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trueflank/design/kinds/train_kind.h"

// The paper: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403.
namespace trueflank {
namespace {

double speed_of(const BalanceTrain& train, const char* member) {
  return train.speeds.of[static_cast<std::size_t>(train.topology.find_member(member))];
}

/// Tooth numbers as people write them, rings positive.
BalanceTrain train_of(const std::string& kind, const std::string& output, std::vector<int> teeth) {
  const Topology topology = train_topology(kind, output);
  for (std::size_t i = 0; i < teeth.size(); ++i)
    if (topology.gears[i].form == GearForm::kRing) teeth[i] = -teeth[i];
  return balance_train(topology, teeth);
}

BalanceTrain train_3k(const std::string& output, const std::vector<int>& teeth, double n_a, double n_b,
                      double n_c) {
  BalanceTrain train = train_of("3k", output, teeth);
  const double n[] = {n_a, n_b, n_c};
  for (std::size_t k = 0; k < 3; ++k)
    train.losses[k] = {n[k], n[k]};
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
  const BalanceTrain train = train_3k("ring2", {12, 39, 90, 32, 81}, 1, 1, 1);
  EXPECT_NEAR(speed_of(train, "sun") / speed_of(train, "ring2"), 96.2419, 5e-5);
  EXPECT_EQ(speed_of(train, "carrier"), 12.0 / 102.0);
  EXPECT_EQ(speed_of(train, "ring1"), 0.0);
}

TEST(EfficiencyBalance, EqualLayersStandExactlyStill) {
  const BalanceTrain train = train_3k("ring2", {12, 30, 72, 35, 84}, 1, 1, 1);
  EXPECT_EQ(speed_of(train, "ring2"), 0.0);
  EXPECT_TRUE(solve_balance(train, DriveDirection::kForward).self_locking);
}

TEST(EfficiencyBalance, AgreesWithTheGeneralExpressionForBothSignsAndDirections) {
  std::mt19937 random(20191014);
  std::uniform_real_distribution<double> loss(0.0, 0.03);
  int same = 0, opposite = 0, locked = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<int> z = random_teeth(random);
    if (z[2] * z[3] == z[1] * z[4] || z[4] <= z[3]) continue;
    const double a = 1 - loss(random), b = 1 - loss(random), c = 1 - loss(random);
    const BalanceTrain train = train_3k("ring2", z, a, b, c);
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
    for (const char* output : {"ring2", "ring1"})
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
    const BalanceTrain train = train_3k("ring2", z, n, n, n);
    EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, row.forward, 6e-4);
    EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency, row.backward, 6e-4);
  }
  // ring power 11.2 and 10.3 times the power that goes through
  const BalanceState ideal =
      solve_balance(train_3k("ring2", z, 1, 1, 1), DriveDirection::kForward);
  EXPECT_NEAR(ideal.meshes[1].rolling_power, 11.2, 0.05);
  EXPECT_NEAR(ideal.meshes[2].rolling_power, 10.3, 0.05);
  EXPECT_TRUE(ideal.meshes[0].gear1_drives);   // S drives P1
  EXPECT_TRUE(ideal.meshes[1].gear1_drives);   // I2 < 1: P1 drives R1
  EXPECT_FALSE(ideal.meshes[2].gear1_drives);  // and R2 drives P2
}

TEST(EfficiencyBalance, PowerInIsPowerOutAndLossesInEveryKindAndDirection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> loss(0.001, 0.02);
  const struct { std::string kind, output; std::vector<int> teeth; } cases[] = {
      {"3k", "ring2", {12, 39, 90, 32, 81}},
      {"3k", "ring1", {12, 39, 90, 32, 81}},
      {"3k", "ring2", {12, 30, 72, 34, 78}},
      {"3k", "ring1", {12, 30, 72, 34, 78}},
      {"simple", "carrier", {12, 30, 72}},
      {"simple", "ring", {12, 30, 72}},
      {"stepped", "carrier", {18, 36, 20, 74}},
      {"stepped", "ring", {18, 36, 20, 74}},
      {"pair", "wheel", {17, 51}}};
  for (const auto& c : cases) {
    BalanceTrain train = train_of(c.kind, c.output, c.teeth);
    for (MeshLosses& mesh : train.losses) {
      mesh.driving1 = 1 - loss(random);
      mesh.driving2 = 1 - loss(random);
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
      // external torques balance about the central axis, where there is but one
      if (train.topology.has_planets()) {
        EXPECT_NEAR(torque, 0.0, 1e-9);
      }
    }
  }
}

TEST(EfficiencyBalance, SimpleSetsFollowTheKnownFormulas) {
  // ring fixed, carrier out: eta = (1 + n_a n_b i0) / (1 + i0) with i0 = z_r / z_s; ring out: n_a n_b
  BalanceTrain train = train_of("simple", "carrier", {12, 30, 72});
  train.losses = {{0.98, 0.98}, {0.99, 0.99}};
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency,
              (1 + 0.98 * 0.99 * 6) / 7, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency,
              7 / (1 + 6 / (0.98 * 0.99)), 1e-12);
  train = train_of("simple", "ring", {12, 30, 72});
  train.losses = {{0.98, 0.98}, {0.99, 0.99}};
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, 0.98 * 0.99, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency, 0.98 * 0.99, 1e-12);
}

TEST(EfficiencyBalance, AMeshThatPassesNoPowerLocksTheTrain) {
  BalanceTrain train = train_3k("ring2", {12, 39, 90, 32, 81}, -0.1, 0.99, 0.99);
  EXPECT_TRUE(solve_balance(train, DriveDirection::kForward).self_locking);
  EXPECT_EQ(solve_balance(train, DriveDirection::kForward).efficiency, 0.0);
}

TEST(EfficiencyBalance, SteppedSetsFollowTheKnownFormulas) {
  // as a simple set with i0 = z_p1 z_r / (z_s z_p2)
  const std::vector<int> z{18, 36, 20, 74};
  const double i0 = 36.0 * 74.0 / (18.0 * 20.0), n = 0.98 * 0.99;
  BalanceTrain train = train_of("stepped", "carrier", z);
  train.losses = {{0.98, 0.98}, {0.99, 0.99}};
  EXPECT_NEAR(1.0 / train.speeds.output, 1 + i0, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, (1 + n * i0) / (1 + i0), 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency, (1 + i0) / (1 + i0 / n), 1e-12);
  train = train_of("stepped", "ring", z);
  train.losses = {{0.98, 0.98}, {0.99, 0.99}};
  EXPECT_NEAR(1.0 / train.speeds.output, -i0, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, n, 1e-12);
}

/// The split-ring set by virtual power seen from the carrier: T_c + T_1 + T_2 = 0 and
/// T_1 w_1 n^s + T_2 w_2 = 0 with n = n_b n_c, s = 1 where the held ring drives there, -1 where it is driven.
double split_ring_efficiency(double i2, double n, bool forward) {
  const double s = (i2 < 1.0) == forward ? 1.0 / n : n;
  const double eta = s * (1.0 - i2) / (s - i2);
  return forward ? eta : 1.0 / eta;
}

TEST(EfficiencyBalance, SplitRingSetsFollowVirtualPowerAndTheSunIdles) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> loss(0.0, 0.03);
  std::uniform_int_distribution<int> planet(9, 40), change(-4, 4);
  int ran = 0, locked = 0;
  for (int i = 0; i < 2000; ++i) {
    const int z_p1 = planet(random), z_p2 = planet(random), z_r1 = z_p1 + 42, z_r2 = z_p2 + 42 + change(random);
    if (z_r1 * z_p2 == z_r2 * z_p1) continue;
    const Topology with_sun = train_topology("3k", "ring2", "carrier");
    ASSERT_TRUE(with_sun.gears[0].optional);
    const std::vector<int> z{z_p1, -z_r1, z_p2, -z_r2};
    BalanceTrain train = balance_train(without_gear(with_sun, 0), z);
    BalanceTrain idling = balance_train(with_sun, {21, z[0], z[1], z[2], z[3]});
    const double b = 1 - loss(random), c = 1 - loss(random);
    train.losses = {{b, b}, {c, c}};
    idling.losses = {{0.5, 0.5}, {b, b}, {c, c}};
    const double i2 = double(z_r1) * z_p2 / (double(z_p1) * z_r2);
    ASSERT_NEAR(train.speeds.output, 1.0 - i2, 1e-14);
    for (const auto direction : {DriveDirection::kForward, DriveDirection::kBackward}) {
      const double expected = split_ring_efficiency(i2, b * c, direction == DriveDirection::kForward);
      const BalanceState state = solve_balance(train, direction), idle = solve_balance(idling, direction);
      const bool runs = expected > 0.0 && expected <= 1.0;
      (runs ? ran : locked)++;
      ASSERT_EQ(state.self_locking, !runs) << z_p1 << ' ' << z_r1 << ' ' << z_p2 << ' ' << z_r2;
      ASSERT_EQ(idle.self_locking, !runs);
      if (!runs) continue;
      ASSERT_NEAR(state.efficiency, expected, 1e-11);
      ASSERT_EQ(idle.efficiency, state.efficiency);
      ASSERT_EQ(idle.meshes[0].loss, 0.0);
      ASSERT_EQ(idle.torque[0], 0.0);
    }
  }
  EXPECT_GT(ran, 1000);
  EXPECT_GT(locked, 50);
}

/// Two simple stages: the first one's carrier is the second one's sun.
Topology two_stages() {
  enum { kSun1, kPlanet1, kShaft, kRing1, kPlanet2, kCarrier2, kRing2 };
  return {.kind = "two stages",
          .axes = {{}, {.carrier = kShaft}, {.carrier = kCarrier2}},
          .members = {{"sun1"}, {"planet1", 1}, {"shaft"}, {"ring1"}, {"planet2", 2}, {"carrier2"}, {"ring2"}},
          .gears = {{"sun1", kSun1}, {"planet1", kPlanet1}, {"ring1", kRing1}, {"sun2", kShaft, 2},
                    {"planet2", kPlanet2, 2}, {"ring2", kRing2, 2}},
          .meshes = {{0, 1}, {1, 2}, {3, 4}, {4, 5}},
          .fixed = {kRing1, kRing2},
          .input = kSun1,
          .output = kCarrier2};
}

TEST(EfficiencyBalance, StagesInSeriesMultiply) {
  BalanceTrain train = balance_train(two_stages(), {12, 30, -72, 18, 27, -72});
  const double n = 0.98 * 0.99;
  train.losses = {{0.98, 0.98}, {0.99, 0.99}, {0.98, 0.98}, {0.99, 0.99}};
  EXPECT_EQ(train.speeds.output, 1.0 / 35.0);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency,
              (1 + n * 6) / 7 * (1 + n * 4) / 5, 1e-12);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kBackward).efficiency,
              7 / (1 + 6 / n) * 5 / (1 + 4 / n), 1e-12);
}

TEST(EfficiencyBalance, AxesInARowReverseAtEveryMesh) {
  // three shafts with an idler between: the middle gear's teeth do not matter, its two meshes do
  const Topology row{.kind = "row",
                     .axes = {{}, {}, {}},
                     .members = {{"pinion"}, {"idler", 1}, {"wheel", 2}},
                     .gears = {{"pinion", 0}, {"idler", 1}, {"wheel", 2}},
                     .meshes = {{0, 1}, {1, 2}},
                     .input = 0,
                     .output = 2};
  BalanceTrain train = balance_train(row, {17, 23, 51});
  train.losses = {{0.98, 0.98}, {0.97, 0.97}};
  EXPECT_EQ(train.speeds.output, 1.0 / 3.0);
  EXPECT_NEAR(solve_balance(train, DriveDirection::kForward).efficiency, 0.98 * 0.97, 1e-12);
}

TEST(Kinematics, HugeToothNumbersAreSolvedInFloatingPoint) {
  // products of these outgrow 63 bits
  const std::vector<int> z{99991, 99989, -299969, 99971, 99961, -299881};
  const MemberSpeeds w = member_speeds(two_stages(), z);
  EXPECT_NEAR(w.output * (1 + 299969.0 / 99991) * (1 + 299881.0 / 99971), 1.0, 1e-12);
}

TEST(Kinematics, WhatNothingHoldsHasNoSpeed) {
  Topology open = train_topology("simple");
  open.fixed.clear();
  for (const double w : {member_speeds(open, {12, 30, -72}).output}) EXPECT_TRUE(std::isnan(w));
}

}  // namespace
}  // namespace trueflank
