// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/train_members.h"
#include "tests/train/prototype_design.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/strength_form_factor.h"

namespace trueflank {
namespace {

using test::laid_out;

GearTrain pair_of(int z1, int z2) { return laid_out(test::unshifted("pair", "wheel", {z1, z2})); }

/// Section of ISO 6336-3 method B for a hobbed external gear, load at the tip, solved from its
/// printed equations (E, G, H, theta by iteration): nothing of the library's profile.
double iso_form_factor(int z, double x, double rho, double dedendum) {
  const double pi = std::acos(-1.0), a = 20 * pi / 180;
  const double e = pi / 4 - dedendum * std::tan(a) - (1 - std::sin(a)) * rho / std::cos(a);
  const double g = rho - dedendum + x;
  const double h = 2.0 / z * (pi / 2 - e) - pi / 3;
  double theta = pi / 6;
  for (int i = 0; i < 50; ++i) theta = 2 * g / z * std::tan(theta) - h;
  const double s = z * std::sin(pi / 3 - theta) + std::sqrt(3.0) * (g / std::cos(theta) - rho);
  const double d_a = z + 2 * (1 + x), d_b = z * std::cos(a);
  const double a_a = std::acos(d_b / d_a);
  const double gamma =
      (pi / 2 + 2 * x * std::tan(a)) / z + (std::tan(a) - a) - (std::tan(a_a) - a_a);
  const double a_f = a_a - gamma;
  const double lever = 0.5 * ((std::cos(gamma) - std::sin(gamma) * std::tan(a_f)) * d_a -
                              z * std::cos(pi / 3 - theta) - (g / std::cos(theta) - rho));
  return 6 * lever * std::cos(a_f) / (s * s * std::cos(a));
}

TEST(StrengthFormFactor, IsThatOfTheThirtyDegreeTangentEquations) {
  for (const int z : {17, 20, 30, 40, 80})
    for (const double x : {-0.3, 0.0, 0.5}) {
      Gear gear{.teeth = z};
      gear.rack.root_radius = 0.38;
      gear.shift = x;
      gear.tip_radius_mm = nominal_tip_radius_mm(gear);
      auto profile = ToothProfile::make(gear);
      ASSERT_TRUE(profile.has_value());
      EXPECT_NEAR(critical_section(*profile).form_factor, iso_form_factor(z, x, 0.38, 1.25), 2e-3)
          << z << ' ' << x;
    }
}

TEST(StrengthFormFactor, KnownChartValuesAreMet) {
  // JGMA 401-01 chart as KHK prints it (rho = 0.375): about 2.8 at z = 20, 2.4 at z = 40, unshifted
  EXPECT_NEAR(iso_form_factor(20, 0, 0.375, 1.25), 2.8, 0.05);
  EXPECT_NEAR(iso_form_factor(40, 0, 0.375, 1.25), 2.4, 0.05);
}

TEST(Strength, PairFollowsTheFormulas) {
  const GearTrain train = pair_of(20, 40);
  StrengthOptions options;
  options.reversing = false;
  options.material = "scm440-hb280";
  const auto result = strength(train, options);
  ASSERT_TRUE(result.has_value());
  const MeshStrength& mesh = result->meshes.front();
  const double contact_ratio = contact_ratios(train.pair(train.meshes[0])).effective;
  EXPECT_NEAR(mesh.tooth1.bending_force_n,
              314 * 1.0 * 10 / (mesh.tooth1.form_factor / contact_ratio) / 1.2, 1e-9);
  // Z_H = 2.495 at 20 degrees, Z_M = 189.8 (steel on steel): textbook values
  EXPECT_NEAR(mesh.factors[4].value, 2.495, 5e-4);
  EXPECT_NEAR(mesh.factors[5].value, 189.8, 0.1);
  const double hertz = 775 / (2.495 * 189.8);
  EXPECT_NEAR(mesh.contact_force_n, hertz * hertz * 20 * 10 * 40.0 / 60 / (1.15 * 1.15), 0.2);
  EXPECT_EQ(result->limiting_mode, "contact");
  EXPECT_NEAR(result->output_torque_nm, mesh.contact_torque1_nm * 2 * efficiency(train).forward,
              1e-9);
}

/// The handbook's worked example of JGMA 401-01, a spur pair of SCM415 (KHK, Gear technical
/// reference, bending strength of spur gears): its printed inputs and results.
TEST(Strength, WorkedExampleOfBendingIsMet) {
  GearboxDesign design = test::unshifted("pair", "wheel", {20, 40});
  design.gears[0].shift = 0.15;
  design.gears[1].shift = -0.15;
  design.module_mm = 2.0;
  design.rack.root_radius = 0.375;
  for (GearDesign& gear : design.gears) gear.face_width_mm = 20.0;
  const GearTrain train = laid_out(design);
  constexpr double kNewtonPerKgf = 9.80665;
  Material steel = *MaterialTable().find(kDefaultMaterial);
  steel.name = "scm415";
  steel.bending_limit_mpa = 42.5 * kNewtonPerKgf;
  StrengthOptions options;
  options.materials.set(steel);
  options.material = steel.name;
  options.reversing = false;
  options.dynamic_factor = 1.4;
  const auto result = strength(train, options);
  ASSERT_TRUE(result.has_value());
  const MeshStrength& mesh = result->meshes.front();
  EXPECT_NEAR(mesh.tooth1.form_factor, 2.568, 1e-3);
  EXPECT_NEAR(mesh.tooth2.form_factor, 2.535, 1e-3);
  EXPECT_NEAR(1 / contact_ratios(train.pair(train.meshes[0])).effective, 0.619, 5e-4);
  EXPECT_NEAR(mesh.tooth1.bending_force_n / kNewtonPerKgf, 636.5, 0.5);
  EXPECT_NEAR(mesh.tooth2.bending_force_n / kNewtonPerKgf, 644.8, 0.5);
}

TEST(Strength, ReversingLoadCostsAThirdOfTheBending) {
  const GearTrain train = pair_of(20, 40);
  StrengthOptions options;
  const double both = strength(train, options)->meshes[0].bending_output_nm;
  options.reversing = false;
  EXPECT_NEAR(both, strength(train, options)->meshes[0].bending_output_nm * 2 / 3, 1e-9);
}

TEST(Strength, APlanetBetweenSunAndRingBendsBothWaysEvenWithoutReversal) {
  const GearTrain train = laid_out(test::prototype(0.46, 1.2, 25.66));
  StrengthOptions options;
  options.reversing = false;
  const auto result = strength(train, options);
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->meshes[0].tooth2.bends_both_ways);   // planet1, driven by the sun
  EXPECT_TRUE(result->meshes[1].tooth1.bends_both_ways);   // planet1, driving ring1
  EXPECT_FALSE(result->meshes[0].tooth1.bends_both_ways);  // sun
  EXPECT_FALSE(result->meshes[2].tooth1.bends_both_ways);  // planet2
}

TEST(Strength, TorqueGrowsWithFaceWidthAndPlanets) {
  GearboxDesign design = test::prototype(0.46, 1.2, 25.66);
  const double one = strength(laid_out(design))->output_torque_nm;
  for (GearDesign& gear : design.gears) gear.face_width_mm *= 2;
  EXPECT_NEAR(strength(laid_out(design))->output_torque_nm, 2 * one, 1e-9 * one);
  design.planets = 6;
  EXPECT_NEAR(strength(laid_out(design))->output_torque_nm, 4 * one, 1e-9 * one);
}

TEST(Strength, TheLimitingToothIsReachedExactlyAtTheStatedTorque) {
  const GearTrain train = laid_out(test::prototype(0.46, 1.2, 25.66));
  const auto result = strength(train);
  ASSERT_TRUE(result.has_value());
  double smallest = 1e300;
  for (const MeshStrength& mesh : result->meshes)
    smallest = std::min({smallest, mesh.bending_output_nm, mesh.contact_output_nm});
  EXPECT_DOUBLE_EQ(result->output_torque_nm, smallest);
  EXPECT_NEAR(result->output_torque_nm / result->input_torque_nm,
              96.2419 * efficiency(train).forward, 1e-3);
}

TEST(Strength, UnknownMaterialIsAnErrorThatNamesTheTable) {
  StrengthOptions options;
  options.material_of["ring"] = "unobtainium";
  const auto result =
      strength(laid_out(test::unshifted("simple", "carrier", {12, 30, 72})), options);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().key, "ring.material");
  EXPECT_NE(result.error().remedy.find("scm440-hb280"), std::string::npos);
}

TEST(Materials, AUserMaterialExtendsAndOverridesTheTable) {
  MaterialTable table;
  const std::size_t built_in = table.all().size();
  table.set({"mine", 100, 500, 200000, 0.3, 7800, ""});
  table.set({"pom", 1, 2, 3, 0.4, 5, ""});
  EXPECT_EQ(table.all().size(), built_in + 1);
  EXPECT_EQ(table.find("pom")->bending_limit_mpa, 1);
  EXPECT_EQ(table.find("nothing"), nullptr);
}

}  // namespace
}  // namespace trueflank
