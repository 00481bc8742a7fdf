// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_iso6336.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/prototype_design.h"
#include "trueflank/train/strength_mesh.h"

namespace trueflank {
namespace {

/// Pair of a worked calculation after DIN 3990-11 (the same Y_Fa, Y_Sa, Y_epsilon, Z_H, Z_E, Z_epsilon, Z_B as ISO 6336
/// for spur gears): the public Python package din3990 by H. Hansl, tests/test_1.py, which prints every factor.
/// Module 4, 19/104 teeth, shifts 0.5 and 0.15, rack 1/1.25/0.25, face 48.64 mm, F_t = 14103.4 N.
GearTrain worked_pair() {
  GearboxDesign design = test::unshifted("pair", "wheel", {19, 104});
  design.module_mm = 4.0;
  design.rack.root_radius = 0.25;
  design.planets = 1;
  design.gears[0].shift = 0.5;
  design.gears[1].shift = 0.15;
  // its tips are not shortened: d_a = m (z + 2 + 2 x)
  design.gears[0].tip_diameter_mm = 88.0;
  design.gears[1].tip_diameter_mm = 425.2;
  for (GearDesign& gear : design.gears) gear.face_width_mm = 48.64;
  return *lay_out(design);
}
constexpr double kForce_n = 14103.41869503906;

StrengthOptions bare() {
  StrengthOptions options;
  options.material = "16mncr5-carburised";
  options.reversing = false;
  options.bending_safety = options.contact_safety = 1.0;
  return options;
}

TEST(Iso6336, HasTheFactorsOfAWorkedCalculation) {
  const auto result = strength_iso6336(worked_pair(), bare());
  ASSERT_TRUE(result.has_value());
  const Iso6336Mesh& mesh = result->meshes.at(0);
  EXPECT_NEAR(mesh.tooth1.form_factor, 2.246336, 3e-3);
  EXPECT_NEAR(mesh.tooth2.form_factor, 2.161657, 3e-3);
  EXPECT_NEAR(mesh.tooth1.notch_factor, 1.914726, 3e-3);
  EXPECT_NEAR(mesh.tooth2.notch_factor, 2.008782, 3e-3);
  EXPECT_NEAR(mesh.tooth1.stress_per_n * kForce_n, 230.15, 0.5);
  EXPECT_NEAR(mesh.tooth2.stress_per_n * kForce_n, 232.35, 0.5);
  EXPECT_NEAR(mesh.zone_factor, 2.395941, 1e-4);
  EXPECT_NEAR(mesh.contact_ratio_factor, 0.906215, 1e-4);
  EXPECT_NEAR(mesh.single_contact_factor1, 1.005547, 1e-4);
  EXPECT_EQ(mesh.single_contact_factor2, 1.0);
  EXPECT_NEAR(mesh.elasticity_factor, 189.8, 0.3);  // steel on steel; 206 and 210 GPa are both printed
  EXPECT_NEAR(mesh.contact_stress_per_root_n * std::sqrt(kForce_n), 875.38, 1.5);
  EXPECT_NEAR(mesh.tooth1.limit_mpa, 860.0, 1e-9);  // sigma_FE of the table's 430 MPa
}

TEST(Iso6336, TorquesAreThoseAtWhichStressesReachTheirLimits) {
  const GearTrain train = worked_pair();
  const auto result = strength_iso6336(train, bare());
  ASSERT_TRUE(result.has_value());
  const Iso6336Mesh& mesh = result->meshes.at(0);
  const double output = output_per_input(train, efficiency(train).forward_drive);
  const double torque1 = mesh.tooth1.limit_mpa / mesh.tooth1.stress_per_n * 38.0e-3;
  EXPECT_NEAR(mesh.tooth1.output_nm, torque1 * output, 1e-6 * torque1);
  const double force = std::pow(1500.0 / (mesh.contact_stress_per_root_n * mesh.single_contact_factor1), 2);
  EXPECT_NEAR(mesh.contact_output_nm, force * 38.0e-3 * output, 1e-6 * force);
  EXPECT_EQ(result->output_torque_nm,
            std::min({mesh.tooth1.output_nm, mesh.tooth2.output_nm, mesh.contact_output_nm}));
}

TEST(Iso6336, LifeBelowTheEnduranceLimitAllowsMore) {
  StrengthOptions options = bare();
  options.input_speed_rpm = 100.0;
  const auto torque = [&](double hours) {
    options.life_h = hours;
    return strength_iso6336(worked_pair(), options)->output_torque_nm;
  };
  EXPECT_GT(torque(1.0), 1.2 * torque(1e4));
  EXPECT_GT(torque(1e4), torque(1e6));
  options.life_h = 500.0;  // 3e6 loads of the pinion: its knee
  const auto result = strength_iso6336(worked_pair(), options);
  EXPECT_NEAR(result->meshes[0].tooth1.cycles, 3e6, 1.0);
  EXPECT_NEAR(result->meshes[0].tooth1.life_factor, 1.0, 1e-9);
  EXPECT_NEAR(result->meshes[0].tooth2.cycles, 3e6 * 19 / 104, 1.0);
}

TEST(Iso6336, PlanetsAndSunCountTheirMeshes) {
  GearboxDesign design = test::unshifted("simple", "carrier", {20, 30, 80});
  for (GearDesign& gear : design.gears) gear.face_width_mm = 10.0;
  StrengthOptions options = bare();
  options.input_speed_rpm = 100.0;
  options.life_h = 1.0;
  const auto result = strength_iso6336(*lay_out(design), options);
  ASSERT_TRUE(result.has_value());
  // sun 1, carrier 1/5: the sun passes 0.8 turns of the carrier a turn, each of its teeth 3 planets
  EXPECT_NEAR(result->meshes[0].tooth1.cycles, 6000 * 0.8 * 3, 1e-6);
  EXPECT_NEAR(result->meshes[0].tooth2.cycles, 6000 * 0.8 * 20 / 30, 1e-6);
}

TEST(Iso6336, ALoadSpectrumIsTheConstantLoadOfEqualDamage) {
  EXPECT_EQ(equivalent_load({}, 6.25), 1.0);
  EXPECT_NEAR(equivalent_load({{1.0, 1.0}}, 6.25), 1.0, 1e-12);
  // damage of half the life at full and half at half load, by Miner
  EXPECT_NEAR(std::pow(equivalent_load({{1.0, 0.5}, {0.5, 0.5}}, 6.0), 6.0), 0.5 + 0.5 / 64.0, 1e-12);
  StrengthOptions options = bare();
  const double full = strength_iso6336(worked_pair(), options)->output_torque_nm;
  options.spectrum = {{1.0, 0.1}, {0.3, 0.9}};
  const double mixed = strength_iso6336(worked_pair(), options)->output_torque_nm;
  EXPECT_GT(mixed, full);
  EXPECT_LT(mixed, 1.5 * full);
}

TEST(Iso6336, ThinRimsCostStrengthAsTheStandardSays) {
  EXPECT_EQ(rim_factor(false, 12.0, 10.0, 4.0), 1.0);
  EXPECT_NEAR(rim_factor(false, 10.0, 10.0, 4.0), 1.6 * std::log(2.242), 1e-12);
  EXPECT_TRUE(std::isnan(rim_factor(false, 5.0, 10.0, 4.0)));
  EXPECT_EQ(rim_factor(true, 14.0, 9.0, 4.0), 1.0);
  EXPECT_NEAR(rim_factor(true, 8.0, 9.0, 4.0), 1.15 * std::log(4.162), 1e-12);
  EXPECT_TRUE(std::isnan(rim_factor(true, 7.0, 9.0, 4.0)));
  GearboxDesign ring = test::unshifted("simple", "carrier", {20, 30, 80});
  for (GearDesign& gear : ring.gears) gear.face_width_mm = 10.0;
  EXPECT_NEAR(strength_iso6336(*lay_out(ring))->meshes[1].tooth2.rim_factor, 1.15 * std::log(8.324 / 2.5), 1e-9);
  ring.gears[2].outer_diameter_mm = 100.0;
  EXPECT_EQ(strength_iso6336(*lay_out(ring))->meshes[1].tooth2.rim_factor, 1.0);
  GearboxDesign design = test::unshifted("pair", "wheel", {24, 60});
  for (GearDesign& gear : design.gears) gear.face_width_mm = 10.0;
  const double solid = strength_iso6336(*lay_out(design))->meshes[0].tooth1.output_nm;
  design.gears[0].bore.diameter_mm = 18.0;  // 1.75 mm under teeth 2.25 high
  const auto bored = strength_iso6336(*lay_out(design));
  EXPECT_GT(bored->meshes[0].tooth1.rim_factor, 1.0);
  EXPECT_NEAR(bored->meshes[0].tooth1.output_nm * bored->meshes[0].tooth1.rim_factor, solid, 1e-9 * solid);
}

}  // namespace
}  // namespace trueflank
