// SPDX-License-Identifier: GPL-3.0-or-later
// A pair whose wheel is a ring, in a box: the wheel is a cup over its pinion.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/machine_designs.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

TEST(RingPairKeys, ABearingUnderTheWheelIsRefused) {
  EXPECT_EQ(first_key(kRingPair + kRingBox), "");
  EXPECT_EQ(first_key(replaced(kRingPair + kRingBox, "outputs = 2", "wheel = \"608\"")),
            "bearings.wheel");
  EXPECT_EQ(
      first_key(replaced(kRingPair, "internal = true", "internal = true\nouter_diameter_mm = 80") +
                kRingBox),
      "wheel.outer_diameter_mm");
}

TEST(RingPairParts, NothingFailsOnAnyMotorThatTheCupHasRoomFor) {
  for (const char* motor : {"nema14", "nema17", "outrunner-5010"}) {
    const Made made(replaced(kRingPair + kRingBox, "nema17", motor));
    for (const Finding& finding : made.findings)
      EXPECT_NE(finding.status, CheckStatus::kFail) << motor << ": " << finding.message;
    for (const char* part : {"pinion", "wheel", "housing", "lid", "retainer", "journal", "output"})
      EXPECT_FALSE(made.part(part).slabs.empty());
  }
}

TEST(RingPairParts, TheCupStaysClearOfTheShaftAndASpacerFillsTheRest) {
  const Made made(kRingPair + kRingBox);
  const auto m = machine_layout(made.train);
  ASSERT_GT(m->shaft_end_mm, 14.0);  // beyond the gears
  EXPECT_NEAR(m->disc.lower_mm - m->shaft_end_mm, m->clearance_mm, 1e-9);
  EXPECT_NEAR(m->spacer.upper_mm, m->shaft_end_mm, 1e-9);
  EXPECT_NEAR(m->gripped.upper_mm, m->shaft_end_mm, 1e-9);
  // the spacer turns inside the cup: a, its own radius, the clearance
  EXPECT_LE(m->output_axis.norm() + m->spacer_radius_mm + m->clearance_mm,
            m->cup_inner_radius_mm + 1e-9);
  EXPECT_GT(m->cup_radius_mm, made.train.gear(1).profile.root_radius_mm() + 1.9);
}

TEST(RingPairParts, AWheelThatRisesOrALidThatSinksCollides) {
  for (const char* name : {"wheel", "lid", "pinion", "journal"}) {
    Made made(kRingPair + kRingBox);
    const double by = std::string(name) == "lid" ? -0.7 : 0.7;
    for (Placement& body : made.shapes.assembly)
      if (body.name == name) body.translation_mm[2] += by;
    EXPECT_FALSE(assembly_clearance(made.train, made.shapes).collisions.empty()) << name;
  }
}

TEST(RingPairChecks, OneBallBearingAloneIsToldAndCrossedRollersAreNot) {
  const Made one(replaced(kRingPair + kRingBox, "outputs = 2\n", ""));
  const Finding& told = one.finding("bearing_load", "output");
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_EQ(told.cure.find("bearings.wheel"), std::string::npos) << told.cure;
  const Made rollers(replaced(kRingPair + kRingBox, "\"6806\"\noutputs = 2", "\"RB3010\""));
  EXPECT_EQ(rollers.finding("bearing_load", "output").status, CheckStatus::kPass);
}

TEST(RingPairChecks, HelicalTeethGoInAndHerringboneTeethFromInsideTheRing) {
  const std::string helical =
      replaced(kRingPair, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 15");
  const Made turned(helical + kRingBox);
  EXPECT_EQ(turned.finding("assembly_order", "train").status, CheckStatus::kPass);
  EXPECT_NE(turned.finding("collision", "train").status, CheckStatus::kFail);
  // the pinion goes into the ring beside its teeth, then across the axis into mesh
  const Made arrows(
      replaced(helical, "helix_angle_deg = 15", "helix_angle_deg = 15\nherringbone = true") +
      kRingBox);
  const AssemblyOrder order = assembly_order(arrows.train, arrows.shapes);
  ASSERT_TRUE(order.exists());
  bool across = false;
  for (const AssemblyUnit& unit : order.units)
    across = across || (unit.name == "pinion_and_wheel" && unit.steps.back().from == 0.0);
  EXPECT_TRUE(across);
}

}  // namespace
}  // namespace trueflank
