// SPDX-License-Identifier: GPL-3.0-or-later
// A pair in a box: what holds for pairs alone. Parts, plates and order of every kind: machine_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

TEST(PairKeys, WhatAPairDoesNotHaveIsTold) {
  EXPECT_EQ(first_key(kPair + kBox), "");
  EXPECT_EQ(first_key(replaced(kPair + kBox, "wheel = \"608\"", "planet = \"608\"")),
            "bearings.planet");
  EXPECT_EQ(first_key(replaced(kPair + kBox, "\"608\"", "\"609\"")), "bearings.wheel");
  EXPECT_EQ(first_key(replaced(kPair, "[wheel]", "[wheel]\nbore_mm = 8") + kBox), "wheel.bore_mm");
  EXPECT_EQ(first_key(kSimple + kBox), "bearings.wheel");
}

TEST(PairKeys, TheWheelsBearingIsWrittenBack) {
  const GearboxDesign design = design_of(kPair + kBox);
  ASSERT_TRUE(design.machine->bearings.wheel);
  EXPECT_EQ(design.machine->bearings.wheel->bore_mm, 8.0);
  EXPECT_EQ(design_of(design_file_text(design, "")), design);
}

TEST(PairParts, TheBoxIsTheSmallestCircleRoundMotorScrewsAndWheel) {
  const Made made(kPair + kBox);
  const auto m = machine_layout(made.train);
  ASSERT_TRUE(m);
  // NEMA 17: screws on 31 mm squares, heads of 5.5 mm in counterbores of 6.1
  const double motor = 0.5 * std::sqrt(2.0) * 31.0 + 3.05 + 0.5;
  const double wheel = made.train.gear(1).profile.tip_radius_mm() + 0.5;
  EXPECT_NEAR(2.0 * m->cavity_radius_mm, 39.0 + motor + wheel, 0.01);
  EXPECT_NEAR(m->housing_axis.x() - m->cavity_radius_mm, -motor, 0.01);
  EXPECT_NEAR(m->housing_axis.x() + m->cavity_radius_mm, 39.0 + wheel, 0.01);
  // 608 in the floor, 6806 in the lid, both on the wheel's axis
  for (const char* name : {"bearing_608", "bearing_6806"})
    for (const Placement& body : made.shapes.assembly)
      if (made.shapes.parts[static_cast<std::size_t>(body.part)].name == name) {
        EXPECT_NEAR(body.translation_mm[0], 39.0, 1e-9);
      }
}

TEST(PairParts, AWheelThatRisesOrALidThatSinksCollides) {
  for (const char* name : {"wheel", "lid", "pinion", "journal"}) {
    Made made(kPair + kBox);
    const double by = std::string(name) == "lid" ? -0.7 : 0.7;
    for (Placement& body : made.shapes.assembly)
      if (body.name == name) body.translation_mm[2] += by;
    EXPECT_FALSE(assembly_clearance(made.train, made.shapes).collisions.empty()) << name;
  }
  // beside its place the wheel's stub is in the floor's bearing
  Made made(kPair + kBox);
  for (Placement& body : made.shapes.assembly)
    if (body.name == "wheel") body.translation_mm[0] += 0.2;
  EXPECT_FALSE(assembly_clearance(made.train, made.shapes).collisions.empty());
}

TEST(PairChecks, TheWheelsBearingsShareTheTeethsForceByTheLever) {
  const Made made(kPair + kBox + "[output]\ntorque_nm = 2\nspeed_rpm = 30\n");
  const auto m = machine_layout(made.train);
  // T over the base radius, 30 mm cos 20 deg
  const WheelForces forces = wheel_forces(made.train, 2.0);
  EXPECT_NEAR(forces.across_n, 2000.0 / (30.0 * std::cos(rad_from_deg(20.0))), 0.01);
  EXPECT_EQ(forces.along_n, 0.0);
  const double floor = 0.5 * (m->stub.bearing.lower_mm + m->stub.bearing.upper_mm);
  const double lid = 0.5 * (m->bearings.lower_mm + m->bearings.upper_mm);
  const double on_floor = forces.across_n * (lid - 6.0) / (lid - floor);
  const BearingLife life =
      bearing_life(*made.train.design.machine->bearings.wheel, {.radial_n = on_floor, .speed_rpm = 30});
  EXPECT_NEAR(made.finding("bearing_load", "wheel").value, life.life_h, 1e-6 * life.life_h);
  const BearingLife other =
      bearing_life(made.train.design.machine->bearings.output,
                   {.radial_n = forces.across_n - on_floor, .speed_rpm = 30});
  EXPECT_NEAR(made.finding("bearing_load", "output").value, other.life_h, 1e-6 * other.life_h);
}

TEST(PairChecks, HelicalTeethPushAlongTheAxis) {
  const std::string helical =
      replaced(kPair, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20");
  const Made made(helical + kBox);
  const WheelForces forces = wheel_forces(made.train, 2.0);
  const TrainGear& wheel = made.train.gear(1);
  // F_a = F_t tan(beta) on the reference circle
  const double reference = 0.5 * 60.0 / std::cos(rad_from_deg(20.0));
  EXPECT_NEAR(forces.along_n, 2000.0 / reference * std::tan(rad_from_deg(20.0)), 0.01);
  EXPECT_EQ(wheel.profile.gear().teeth, 60);
  EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(PairChecks, OneBallBearingAloneHoldsNoTilting) {
  const std::string alone = replaced(kPair + kBox, "wheel = \"608\"\n", "");
  const Made one(alone);
  EXPECT_EQ(one.finding("bearing_load", "output").status, CheckStatus::kWarn);
  EXPECT_NE(one.finding("bearing_load", "output").cure.find("bearings.wheel"), std::string::npos);
  const Made two(replaced(alone, "\"6806\"", "\"6806\"\noutputs = 2"));
  EXPECT_EQ(two.finding("bearing_load", "output").status, CheckStatus::kPass);
}

TEST(PairChecks, AShoulderThatCoversTheInsertsIsTold) {
  const Made made(replaced(kPair + kBox, "\"608\"", "\"6804\""));
  EXPECT_EQ(made.finding("bearing_seat", "wheel").status, CheckStatus::kFail);
  EXPECT_EQ(Made(kPair + kBox).finding("bearing_seat", "wheel").status, CheckStatus::kPass);
}

TEST(PairChecks, AHerringbonePairGoesInTogether) {
  const Made made(replaced(kPair, "module_mm = 1",
                           "module_mm = 1\nhelix_angle_deg = 20\nherringbone = true") +
                  kBox);
  EXPECT_EQ(wheel_forces(made.train, 2.0).along_n, 0.0);
  const AssemblyOrder order = assembly_order(made.train, made.shapes);
  ASSERT_TRUE(order.exists());
  bool together = false;
  for (const AssemblyUnit& unit : order.units) together = together || unit.name == "pinion_and_wheel";
  EXPECT_TRUE(together);
}

}  // namespace
}  // namespace trueflank
