// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "trueflank/train/losses.h"

namespace trueflank {
namespace {

MeshEfficiencies meshes(double per_friction) {
  return [per_friction](double forward, double backward) {
    return std::pair(1.0 - per_friction * forward, 1.0 - per_friction * backward);
  };
}

TEST(Losses, WithoutAmountsTheyAreTheMeshesAlone) {
  LossesDesign none;
  none.load_nm = 10.0;
  const LossyEfficiency e = lossy_efficiency(none, 0.1, 96.0, meshes(1.0));
  EXPECT_DOUBLE_EQ(e.forward, 0.9);
  EXPECT_DOUBLE_EQ(e.backward, 0.9);
  EXPECT_EQ(e.loss_forward_nm, 0.0);
}

TEST(Losses, DragTakesItsShareOfTheLoad) {
  LossesDesign drag;
  drag.load_nm = 96.0;  // 1 N m at the input
  drag.drag_torque_nm = 0.05;
  const LossyEfficiency e = lossy_efficiency(drag, 0.1, 96.0, meshes(1.0));
  EXPECT_NEAR(e.forward, 1.0 / (1.0 / 0.9 + 0.05), 1e-15);
  EXPECT_NEAR(e.backward, 0.9 - 0.05, 1e-15);
  drag.load_nm = 4.0;
  EXPECT_EQ(lossy_efficiency(drag, 0.1, 96.0, meshes(1.0)).backward, 0.0);
}

TEST(Losses, FadeAndGrowAsTheySay) {
  LossesDesign l;
  l.viscous_nm_per_rpm = 1e-3;
  l.viscous_per_c = 0.02;
  l.bearing_nm_at_1000_rpm = 0.4;
  l.stribeck_torque_nm = 0.3;
  l.stribeck_speed_rpm = 100.0;
  EXPECT_NEAR(loss_torque_nm(l, {true, 1000.0, 1.0, 25.0}, 1.0), 1.0 + 0.4, 1e-12);
  EXPECT_NEAR(loss_torque_nm(l, {true, 8000.0, 1.0, 75.0}, 1.0), 8.0 * std::exp(-1.0) + 0.4 * 4.0, 1e-12);
  EXPECT_NEAR(loss_torque_nm(l, {true, 0.0, 1.0, 25.0}, 1.0), 0.3, 1e-12);
}

TEST(Losses, FrictionMayDependOnDirectionAndLoad) {
  LossesDesign l;
  l.backward_friction = 0.2;
  l.load_friction = 0.04;
  l.load_friction_exponent = 2.0;
  l.load_friction_reference_nm = 2.0;
  EXPECT_NEAR(mesh_friction(l, 0.1, {true, 0.0, 1.0, 25.0}), 0.11, 1e-15);
  EXPECT_NEAR(mesh_friction(l, 0.1, {false, 0.0, 2.0, 25.0}), 0.24, 1e-15);
}

}  // namespace
}  // namespace trueflank
