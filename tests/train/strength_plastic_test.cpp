// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_plastic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/prototype_design.h"
#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

GearTrain pair_train() {
  GearboxDesign design = test::unshifted("pair", "wheel", {20, 40});
  for (GearDesign& gear : design.gears) gear.face_width_mm = 10.0;
  return *lay_out(design);
}

StrengthOptions of(const char* pinion, const char* wheel) {
  StrengthOptions options;
  options.material_of = {{"pinion", pinion}, {"wheel", wheel}};
  options.reversing = false;
  return options;
}

TEST(PlasticLimit, FallsWithHeatAndLoads) {
  const PlasticLimit pom = MaterialTable().find("pom")->plastic->root;
  EXPECT_NEAR(pom.at(20.0, 1e8), 26.0 - 1.0 + 400.0 * std::pow(1e8, -0.2), 1e-12);
  EXPECT_LT(pom.at(80.0, 1e8), 0.7 * pom.at(20.0, 1e8));
  EXPECT_LT(pom.at(20.0, 1e8), pom.at(20.0, 1e6));
  EXPECT_EQ(pom.at(500.0, 1e8), 0.0);
}

TEST(PlasticLimit, AtRoomTemperatureIsAboutTheOneFigureOfTheTable) {
  const MaterialTable table;
  int plastics = 0;
  for (const Material& m : table.all()) {
    if (!m.plastic) continue;
    ++plastics;
    EXPECT_NEAR(m.plastic->root.at(23.0, 1e8), m.bending_limit_mpa, 1.5) << m.name;
    EXPECT_FALSE(m.plastic->source.empty()) << m.name;
    EXPECT_GT(m.plastic->highest_c, 40.0) << m.name;
  }
  EXPECT_EQ(plastics, 8);
}

TEST(StrengthPlastic, SteelIsNotRated) {
  const auto result = strength_plastic(pair_train(), of("s45c-hb250", "s45c-hb250"));
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(std::isnan(result->output_torque_nm));
  EXPECT_TRUE(result->teeth.empty());
}

TEST(StrengthPlastic, AtTheAllowableTorqueTheFirstLimitIsReached) {
  StrengthOptions options = of("s45c-hb250", "pom");
  options.input_speed_rpm = 1000.0;
  const auto result = strength_plastic(pair_train(), options);
  ASSERT_TRUE(result.has_value());
  ASSERT_EQ(result->teeth.size(), 1u);
  const PlasticTooth& t = result->teeth[0];
  EXPECT_EQ(t.gear, "wheel");
  EXPECT_GT(t.root_c, options.ambient_c);
  EXPECT_NEAR(t.flank_c - options.ambient_c, 7.0 * (t.root_c - options.ambient_c), 1e-9);
  const double most = std::max({options.bending_safety * t.root_stress_mpa / t.root_limit_mpa,
                                options.contact_safety * t.flank_stress_mpa / t.flank_limit_mpa,
                                (t.flank_c - 20.0) / (90.0 - 20.0)});
  EXPECT_NEAR(most, 1.0, 1e-6);
}

TEST(StrengthPlastic, TheTemperatureIsThatOfTheLostPower) {
  StrengthOptions options = of("s45c-hb250", "pom");
  options.input_speed_rpm = 1000.0;
  const GearTrain train = pair_train();
  const auto result = strength_plastic(train, options);
  const EfficiencyResult e = efficiency(train);
  // by hand: power through the pair, friction 0.09 of grease, 40 teeth, 10 mm, module 1
  const double power_w = result->output_torque_nm / e.forward * kTwoPi * 1000.0 / 60.0 * 20.0 / 40.0;
  const double lost_w = power_w * (1.0 - e.forward) / train.design.friction * 0.09;
  const double speed = kTwoPi * 1000.0 / 60.0 * 0.01;
  const double rise = 1.0e3 * lost_w / (10.0 * 40.0 * std::pow(speed * 1.0, 0.75));
  EXPECT_NEAR(result->teeth[0].root_c - 20.0, rise, 0.02 * rise);
}

TEST(StrengthPlastic, SpeedHeatAndFrictionCost) {
  const auto torque = [](StrengthOptions o, double rpm, double ambient) {
    o.input_speed_rpm = rpm;
    o.ambient_c = ambient;
    return strength_plastic(pair_train(), o)->output_torque_nm;
  };
  const StrengthOptions steel = of("s45c-hb250", "pom");
  EXPECT_GT(torque(steel, 10, 20), torque(steel, 3000, 20));
  EXPECT_GT(torque(steel, 1000, 20), torque(steel, 1000, 70));
  StrengthOptions dry = steel, oil = steel;
  dry.lubrication = "dry";
  oil.lubrication = "oil";
  EXPECT_GT(torque(oil, 3000, 20), torque(steel, 3000, 20));
  EXPECT_GT(torque(steel, 3000, 20), torque(dry, 3000, 20));
  EXPECT_EQ(torque(steel, 1000, 95), 0.0);  // warmer than it may be
}

TEST(StrengthPlastic, PlasticOnPlasticIsWarmerAndSofter) {
  const auto wheel = [](const char* pinion) {
    StrengthOptions options = of(pinion, "pom");
    options.input_speed_rpm = 3000.0;
    const auto result = strength_plastic(pair_train(), options);
    PlasticTooth tooth = result->teeth.back();
    tooth.root_c = (tooth.root_c - options.ambient_c) / result->output_torque_nm;
    tooth.flank_stress_mpa /= std::sqrt(result->output_torque_nm);
    return tooth;
  };
  const PlasticTooth on_steel = wheel("s45c-hb250"), on_pom = wheel("pom");
  EXPECT_NEAR(on_pom.root_c, 2.4 * on_steel.root_c, 1e-6 * on_pom.root_c);
  EXPECT_LT(on_pom.flank_stress_mpa, on_steel.flank_stress_mpa);
}

TEST(StrengthPlastic, WearIsToldOfDryTeethAlone) {
  StrengthOptions options = of("s45c-hb250", "pom");
  options.input_speed_rpm = 300.0;
  options.life_h = 100.0;
  EXPECT_TRUE(std::isnan(strength_plastic(pair_train(), options)->teeth[0].wear_um));
  options.lubrication = "dry";
  const double hundred = strength_plastic(pair_train(), options)->teeth[0].wear_um;
  EXPECT_GT(hundred, 0.0);
  EXPECT_GT(strength_plastic(pair_train(), options)->teeth[0].bent_um, 0.0);
}

}  // namespace
}  // namespace trueflank
