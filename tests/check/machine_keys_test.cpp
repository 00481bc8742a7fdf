// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of what is around the gears.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/check/machine_designs.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/train/machine/bed.h"

namespace trueflank {
namespace {

TEST(MachineKeys, AreReadAndWrittenBack) {
  const std::string text =
      replaced(k3k + kMachine, "name = \"nema17\"", "name = \"nema17\"\nshaft_length_mm = 20") +
      "bed = \"ender-3\"\n[output]\nspeed_rpm = 5\ntorque_nm = 3\n";
  const GearboxDesign design = design_of(text);
  ASSERT_TRUE(design.machine);
  EXPECT_EQ(design.machine->motor.shaft_length_mm, 20.0);
  EXPECT_EQ(design.machine->motor.pilot_diameter_mm, 22.0);
  EXPECT_EQ(design.machine->bearings.output.outer_mm, 42.0);
  EXPECT_EQ(design.machine->fasteners.carrier.insert_length_mm, 4.0);
  const GearboxDesign again = design_of(design_file_text(design, ""));
  EXPECT_EQ(again, design);
}

TEST(MachineKeys, TheSunGetsTheBoreOfTheMotorsShaft) {
  const GearboxDesign design = design_of(k3k + kMachine);
  EXPECT_EQ(design.gears[0].bore.kind, BoreKind::kDFlat);
  EXPECT_NEAR(design.gears[0].bore.diameter_mm, 5.1, 1e-12);
  EXPECT_NEAR(design.gears[0].bore.d_flat_mm, 4.6, 1e-12);
}

TEST(MachineKeys, WhatDoesNotAgreeIsTold) {
  const std::string whole = k3k + kMachine;
  EXPECT_EQ(first_key(whole), "");
  EXPECT_EQ(first_key(replaced(whole, "[housing]\n", "")), "motor");
  EXPECT_EQ(first_key(replaced(whole, "[motor]\nname = \"nema17\"\n", "")), "motor");
  EXPECT_EQ(first_key(replaced(whole, "nema17", "nema18")), "motor.name");
  EXPECT_EQ(first_key(replaced(whole, "name = \"nema17\"", "shaft_diameter_mm = 5")),
            "motor.shaft_length_mm");
  EXPECT_EQ(first_key(replaced(whole, "nema17\"", "nema17\"\nflat_mm = 2")), "motor.flat_mm");
  EXPECT_EQ(first_key(replaced(whole, "output = \"6806\"\n", "")), "bearings.output");
  EXPECT_EQ(first_key(replaced(whole, "\"625\"", "\"652\"")), "bearings.planet");
  EXPECT_EQ(first_key(replaced(whole, "M3-short", "M3.1")), "fasteners.carrier");
  EXPECT_EQ(first_key(replaced(whole, "teeth = 90", "teeth = 90\nouter_diameter_mm = 99")),
            "ring1.outer_diameter_mm");
  EXPECT_EQ(first_key(whole + "bed = \"10x10\"\n"), "made.bed");
  EXPECT_EQ(first_key("format = 1\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1\n[gear]\nteeth = 20\n"
                      "face_width_mm = 5\n" +
                      kMachine),
            "housing");
}

TEST(MachineKeys, AUsersElementsReplaceAndAdd) {
  const auto tools = read_tools_text(
      "[bearing.6806]\ndynamic_n = 1\n[motor.mine]\nshaft_diameter_mm = 4\n"
      "[screw.M7]\ndiameter_mm = 7\n[bearing.XR20]\nbore_mm = 20\nkind = \"crossed-rollers\"\n",
      "tools.toml");
  ASSERT_TRUE(tools);
  const Bearing* bearing = find_element(tools->elements.bearings, "6806");
  EXPECT_EQ(bearing->dynamic_n, 1.0);
  EXPECT_EQ(bearing->outer_mm, 42.0);
  EXPECT_EQ(find_element(tools->elements.motors, "mine")->shaft_diameter_mm, 4.0);
  EXPECT_NE(find_element(tools->elements.screws, "M7"), nullptr);
  EXPECT_EQ(find_element(tools->elements.bearings, "XR20")->kind, BearingKind::kCrossedRollers);
  EXPECT_EQ(bearing->kind, BearingKind::kBalls);
  EXPECT_FALSE(read_tools_text("[bearing.XR20]\nkind = \"rollers\"\n", "tools.toml"));
  EXPECT_FALSE(read_tools_text("[motor.mine]\nshaft_mm = 4\n", "tools.toml"));
}

TEST(MachineKeys, EveryElementAndToolKeyIsInTheDocumentation) {
  std::ostringstream page;
  page << std::ifstream(std::string(TRUEFLANK_SOURCE_DIR) + "/docs/gearbox.md").rdbuf();
  const std::string text = page.str();
  const auto names = [&](const std::string& name) {
    return text.find("`" + name + "`") != std::string::npos;
  };
  const MachineElements& elements = standard_elements();
  for (const Motor& motor : elements.motors) EXPECT_TRUE(names(motor.name)) << motor.name;
  for (const Bearing& bearing : elements.bearings) EXPECT_TRUE(names(bearing.name)) << bearing.name;
  for (const Screw& screw : elements.screws) EXPECT_TRUE(names(screw.name)) << screw.name;
  for (const Bed& bed : standard_beds()) EXPECT_TRUE(names(bed.name)) << bed.name;
  for (const char* kind : {"bearing", "screw"})
    for (const KeyRule& rule : tool_key_rules(kind))
      EXPECT_NE(text.find(rule.name), std::string::npos) << rule.name;
}

}  // namespace
}  // namespace trueflank
