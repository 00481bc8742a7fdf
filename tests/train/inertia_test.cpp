// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/inertia.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/prototype_design.h"
#include "tests/support/train_members.h"

// The paper: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403, section II.
namespace trueflank {
namespace {

GearTrain prototype_train() { return *lay_out(test::prototype(0.46, 1.2, 25.66)); }

TEST(Inertia, EquivalentMassesFollowThePaper) {
  const GearTrain train = prototype_train();
  const EfficiencyResult e = efficiency(train);
  const double g = 1 / 96.24193548387096;
  BodyInertias bodies;
  test::inertia_of(train, bodies, "ring2").axial_kg_m2 = 0.02;
  const ReflectedInertia r =
      reflected_inertia(train, e, bodies, {.rotor_kg_m2 = 1e-5, .load_kg_m2 = 0.1});
  EXPECT_NEAR(r.at_input_forward_kg_m2, 1e-5 + g * g / e.forward * 0.12, 1e-12);
  EXPECT_NEAR(r.at_output_forward_kg_m2, e.forward / (g * g) * 1e-5 + 0.12, 1e-9);
  // one is the other times eta / G^2
  EXPECT_NEAR(r.at_output_forward_kg_m2, r.at_input_forward_kg_m2 * e.forward / (g * g), 1e-9);
  EXPECT_NEAR(r.at_output_backward_kg_m2, r.at_input_backward_kg_m2 / (e.backward * g * g), 1e-9);
  EXPECT_LT(r.at_output_forward_kg_m2, r.at_output_lossless_kg_m2);
  EXPECT_GT(r.at_output_backward_kg_m2, r.at_output_lossless_kg_m2);
}

TEST(Inertia, PlanetsAndCarrierCountWithTheirSpeeds) {
  const GearTrain train = prototype_train();
  const double planet = test::speed_of(train, "planet"), carrier = test::speed_of(train, "carrier");
  const EfficiencyResult e = efficiency(train);
  BodyInertias bodies;
  test::inertia_of(train, bodies, "sun").axial_kg_m2 = 1e-6;
  test::inertia_of(train, bodies, "planet") = {.axial_kg_m2 = 2e-6, .mass_kg = 0.05};
  test::inertia_of(train, bodies, "carrier").axial_kg_m2 = 3e-5;
  // kinetic energy at one radian a second of the sun, body by body
  const double v = 25.66e-3 * carrier;
  const double energy = 0.5 * 1e-6 + 3 * (0.5 * 2e-6 * planet * planet + 0.5 * 0.05 * v * v) +
                        0.5 * 3e-5 * carrier * carrier;
  EXPECT_NEAR(reflected_inertia(train, e, bodies).input_side_kg_m2, 2 * energy, 1e-15);
}

TEST(Inertia, StartingTorqueOfThePrototypeAgreesWithItsDrag) {
  // 0.020 N m at the output, backward efficiency 0.88: 1.8e-4 N m at the sun
  EfficiencyResult e;
  e.forward = 0.89;
  e.backward = 0.88;
  const GearTrain train = prototype_train();
  const BodyInertias bodies(train.topology().members.size());
  const ReflectedInertia r = reflected_inertia(train, e, bodies, {.drag_torque_nm = 1.829e-4});
  EXPECT_NEAR(r.starting_torque_nm, 0.020, 1e-5);
}

TEST(Inertia, ALockedTrainFeelsInfinite) {
  EfficiencyResult e;
  e.forward = 0.4;
  e.backward = 0.0;
  e.self_locking = true;
  const GearTrain train = prototype_train();
  BodyInertias bodies;
  test::inertia_of(train, bodies, "sun").axial_kg_m2 = 1;
  const ReflectedInertia r = reflected_inertia(train, e, bodies, {.drag_torque_nm = 1});
  EXPECT_TRUE(std::isinf(r.at_output_backward_kg_m2));
  EXPECT_TRUE(std::isinf(r.starting_torque_nm));
  EXPECT_DOUBLE_EQ(r.at_input_backward_kg_m2, 1.0);
}

TEST(Inertia, RuleOfTheInclinedSurface) {
  EXPECT_NEAR(inclined_surface_backward_efficiency(0.89), 0.876, 5e-4);
  EXPECT_EQ(inclined_surface_backward_efficiency(0.4), 0.0);
  EXPECT_EQ(inclined_surface_backward_efficiency(0.5), 0.0);
}

}  // namespace
}  // namespace trueflank
