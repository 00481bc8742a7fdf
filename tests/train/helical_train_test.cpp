// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "prototype_design.h"
#include "tests/support/train_members.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/axial_thrust.h"
#include "trueflank/train/mesh_face.h"
#include "trueflank/train/strength.h"
#include "trueflank/train/strength_form_factor.h"

namespace trueflank {
namespace {

using test::laid_out;

GearboxDesign helical_pair(int z1, int z2, double module_mm, double helix_deg, bool internal = false) {
  GearboxDesign design{.name = "pair", .topology = train_topology("pair"),
                       .module_mm = module_mm, .helix_angle_rad = rad_from_deg(helix_deg)};
  design.gears = {GearDesign{.name = "pinion", .teeth = z1, .shift = 0.0, .face_width_mm = 20.0},
                  GearDesign{.name = "wheel",
                             .kind = internal ? GearKind::kInternal : GearKind::kExternal,
                             .teeth = z2, .shift = 0.0, .face_width_mm = 20.0}};
  return design;
}

TEST(HelicalTrain, NormalSystemExampleOfKhk) {
  // KHK, Gear technical reference, "the calculations of a profile shifted helical gear, normal
  // system": m_n 3, alpha_n 20, beta 30, z 12/60, x 0.09809/0
  GearboxDesign design = helical_pair(12, 60, 3.0, 30.0);
  design.gears[0].shift = 0.09809;
  const GearTrain train = laid_out(design);
  const GearPair pair = train.pair(train.meshes[0]);
  EXPECT_NEAR(deg_from_rad(transverse_pressure_angle_rad(pair.gear1())), 22.79588, 5e-6);
  EXPECT_NEAR(deg_from_rad(working_pressure_angle_rad(pair)), 23.1126, 5e-5);
  EXPECT_NEAR(train.centre_distance_mm, 125.000, 5e-4);
  EXPECT_NEAR(2.0 * reference_radius_mm(pair.gear1()), 41.569, 5e-4);
  EXPECT_NEAR(2.0 * reference_radius_mm(pair.gear2()), 207.846, 5e-4);
  EXPECT_NEAR(2.0 * base_radius_mm(pair.gear1()), 38.322, 5e-4);
  EXPECT_NEAR(2.0 * base_radius_mm(pair.gear2()), 191.611, 5e-4);
  // the table goes on from the rounded y = 0.09744
  EXPECT_NEAR(2.0 * pair.profile1->tip_radius_mm(), 48.153, 1e-3);
  EXPECT_NEAR(2.0 * pair.profile2->tip_radius_mm(), 213.842, 1e-3);
}

TEST(HelicalTrain, PublishedShiftSumComesOut) {
  // ISO 21771 worked through in "Gear generating profile shift calculations" (scribd 376176518)
  GearboxDesign design = helical_pair(31, 30, 3.5, 0.0);
  design.helix_angle_rad = std::acos(3.5 * 61.0 / (2.0 * 114.3447280708));
  design.centre_distance_mm = 116.5;
  design.gears[1].shift.reset();
  const GearTrain train = laid_out(design);
  EXPECT_NEAR(deg_from_rad(working_pressure_angle_rad(train.pair(train.meshes[0]))), 23.8707609654,
              1e-8);
  EXPECT_NEAR(train.gears[1].shift, 0.6518771312, 1e-8);
}

TEST(HelicalTrain, FormFactorIsThatOfTheVirtualSpurGear) {
  // a helix whose virtual gear has a whole number of teeth: cos^2(beta_b) cos(beta) = 24 / 29
  double low = 0.0, high = 0.7;
  Gear gear{.teeth = 24, .shift = 0.1};
  for (int i = 0; i < 60; ++i) {
    gear.helix_angle_rad = 0.5 * (low + high);
    const double cos_b = std::cos(base_helix_angle_rad(gear));
    (cos_b * cos_b * std::cos(gear.helix_angle_rad) > 24.0 / 29.0 ? low : high) =
        gear.helix_angle_rad;
  }
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  Gear spur{.teeth = 29, .shift = 0.1};
  spur.tip_radius_mm = nominal_tip_radius_mm(spur);
  const auto helical = ToothProfile::make(gear), straight = ToothProfile::make(spur);
  ASSERT_TRUE(helical && straight);
  EXPECT_NEAR(form_factor(*helical), critical_section(*straight).form_factor, 1e-6);
  // and the transverse section is not far from it
  EXPECT_NEAR(critical_section(*helical).form_factor, form_factor(*helical),
              0.15 * form_factor(*helical));
  EXPECT_EQ(form_factor(*straight), critical_section(*straight).form_factor);
}

TEST(HelicalTrain, StrengthTakesTheHelixAsTheStandardSays) {
  const auto factor = [](double helix_deg, const std::string& symbol) {
    const GearTrain train = laid_out(helical_pair(20, 40, 2.0, helix_deg));
    const auto result = strength(train);
    for (const StrengthFactor& f : result->meshes[0].factors)
      if (f.symbol == symbol) return f.value;
    return kNaN;
  };
  // JGMA 401-01: Y_beta = 1 - beta / 120 up to 30 degrees, then 0.75
  EXPECT_NEAR(factor(15.0, "Y_beta"), 0.875, 1e-12);
  EXPECT_NEAR(factor(-24.0, "Y_beta"), 0.8, 1e-12);
  EXPECT_NEAR(factor(35.0, "Y_beta"), 0.75, 1e-12);
  // JGMA 402-01: Z_H of standard gears, beta 20: sqrt(2 cos b_b / tan a_t) / cos a_t
  const double alpha_t = std::atan(std::tan(rad_from_deg(20.0)) / std::cos(rad_from_deg(20.0)));
  const double beta_b = std::atan(std::tan(rad_from_deg(20.0)) * std::cos(alpha_t));
  EXPECT_NEAR(factor(20.0, "Z_H"),
              std::sqrt(2.0 * std::cos(beta_b) / std::tan(alpha_t)) / std::cos(alpha_t), 1e-9);
  // overlap 20 sin 20 / (2 pi) = 1.089 > 1: Z_epsilon = sqrt(1 / epsilon_alpha)
  const GearTrain train = laid_out(helical_pair(20, 40, 2.0, 20.0));
  EXPECT_NEAR(factor(20.0, "Z_epsilon"),
              std::sqrt(1.0 / contact_ratios(train.pair(train.meshes[0])).effective), 1e-12);
}

TEST(HelicalTrain, OverlapIsThatOfOneHelix) {
  GearboxDesign design = helical_pair(20, 40, 2.0, 20.0);
  const double whole = 20.0 * std::sin(rad_from_deg(20.0)) / (kPi * 2.0);
  GearTrain train = laid_out(design);
  EXPECT_NEAR(overlap_ratio(train, train.meshes[0]), whole, 1e-12);
  design.herringbone = true;
  design.relief_groove_mm = 4.0;
  train = laid_out(design);
  EXPECT_NEAR(overlap_ratio(train, train.meshes[0]), 0.4 * whole, 1e-12);
  EXPECT_NEAR(common_face(train, train.meshes[0]).carrying_mm, 16.0, 1e-12);
}

/// Force of a frictionless flank by its real normal: the surface's normal by differences at a point of
/// the flank that drives or is driven, scaled to a torque.
double axial_by_normal(const TrainGear& gear, int side, double torque_nmm) {
  const Toothing toothing = gear.toothing();
  std::size_t flank = 0;
  while (gear.profile.pieces()[flank].kind != PieceKind::kInvolute) ++flank;
  const Curve& c = gear.profile.pieces()[flank].curve;
  const double mid = 0.5 * (c.begin + c.end), h = 1e-5 * (c.end - c.begin);
  const auto at = [&](double xi, double z) {
    return surface_point(toothing, {0, side, flank, xi}, z);
  };
  const auto p = at(mid, 5.0), a = at(mid + h, 5.0), b = at(mid - h, 5.0), e = at(mid, 5.001),
             f = at(mid, 4.999);
  const double u[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  const double v[3] = {e[0] - f[0], e[1] - f[1], e[2] - f[2]};
  const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double moment = p[0] * n[1] - p[1] * n[0];
  return torque_nmm / moment * n[2];
}

TEST(AxialThrust, IsTheNormalsOwnWhateverTheHandAndKind) {
  for (bool internal : {false, true})
    for (double helix : {20.0, -33.0}) {
      GearboxDesign design = helical_pair(20, 60, 2.0, helix, internal);
      design.friction = 0.0;
      const GearTrain train = laid_out(design);
      const DirectionEfficiency drive = efficiency(train).forward_drive;
      const AxialThrust thrust = axial_thrust(train, drive);
      // the sun is driven counter-clockwise: the mesh holds it back with -1 N m
      EXPECT_NEAR(drive.meshes[0].torque1, -1.0, 1e-9);
      EXPECT_NEAR(thrust.meshes[0].on_gear1_n_per_nm,
                  axial_by_normal(train.gears[0], 1, 1e3 * drive.meshes[0].torque1), 1e-4);
      EXPECT_NEAR(-thrust.meshes[0].on_gear1_n_per_nm,
                  axial_by_normal(train.gears[1], 1, 1e3 * drive.meshes[0].torque2), 1e-4);
      // F_t tan(beta) at the reference circle
      EXPECT_NEAR(std::abs(thrust.meshes[0].on_gear1_n_per_nm),
                  1e3 / reference_radius_mm(train.gears[0].profile.gear()) *
                      std::tan(rad_from_deg(std::abs(helix))),
                  1e-9);
    }
}

TEST(AxialThrust, CancelsOnAnIdlerAndOnHerringboneTeethAndAddsUpToNothing) {
  GearboxDesign design = test::unshifted("simple", "carrier", {18, 21, 60});
  design.helix_angle_rad = rad_from_deg(15.0);
  design.friction = 0.0;
  const auto bodies = [](const GearTrain& train) {
    return axial_thrust(train, efficiency(train).forward_drive).bodies;
  };
  const auto simple = bodies(laid_out(design));
  EXPECT_NEAR(simple[1].n_per_nm, 0.0, 1e-9);            // planet
  EXPECT_NEAR(simple[0].n_per_nm, -simple[2].n_per_nm, 1e-9);  // sun against ring
  EXPECT_GT(std::abs(simple[0].n_per_nm), 1.0);
  design.herringbone = true;
  for (const auto& body : bodies(laid_out(design))) EXPECT_EQ(body.n_per_nm, 0.0);

  GearboxDesign compound = test::prototype(0.5225, 1.9967, 25.6826);
  compound.centre_distance_mm.reset();
  compound.gears[2].shift.reset();
  compound.gears[4].shift.reset();
  compound.helix_angle_rad = rad_from_deg(12.0);
  const GearTrain train = laid_out(compound);
  double sum = 0.0;
  for (const auto& body : bodies(train)) sum += body.n_per_nm * (body.name == "planet" ? 3.0 : 1.0);
  EXPECT_NEAR(sum, 0.0, 1e-9);
  // both layers pull at the planet, and do not cancel in general
  EXPECT_GT(std::abs(bodies(train)[1].n_per_nm), 1.0);
}

}  // namespace
}  // namespace trueflank
