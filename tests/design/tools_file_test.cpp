// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/tools_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/scratch_folder.h"
#include "trueflank/base/units.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace {

std::string gear_file(const std::string& more, double module_mm = 1.0) {
  return "format = 1\n[gearbox]\nkind = \"gear\"\nmodule_mm = " + std::to_string(module_mm) + "\n" +
         more + "\n[gear]\nteeth = 30\nface_width_mm = 8\n";
}

GearboxDesign read_gear(const std::string& text) {
  const auto design = read_design_text(text, "a.toml");
  EXPECT_TRUE(design) << design.error().front().key << ": " << design.error().front().message;
  return design ? *design : GearboxDesign{};
}

Error error_of_gear(const std::string& text) {
  const auto design = read_design_text(text, "a.toml");
  EXPECT_FALSE(design);
  return design ? Error{} : design.error().front();
}

TEST(StandardTools, HaveTheValuesOfIso53) {
  struct Row {
    const char* name;
    double dedendum, root_radius;
  };
  for (const Row& row : {Row{"ISO53-A", 1.25, 0.38}, Row{"ISO53-B", 1.25, 0.30},
                         Row{"ISO53-C", 1.25, 0.25}, Row{"ISO53-D", 1.40, 0.39}}) {
    const RackTool* tool = find_rack(standard_tools(), row.name);
    ASSERT_NE(tool, nullptr) << row.name;
    EXPECT_EQ(tool->rack.dedendum, row.dedendum);
    EXPECT_EQ(tool->rack.root_radius, row.root_radius);
    EXPECT_EQ(tool->rack.addendum, 1.0);
    EXPECT_NEAR(deg_from_rad(tool->rack.pressure_angle_rad), 20.0, 1e-12);
  }
  EXPECT_EQ(find_rack(standard_tools(), "ISO53-A")->rack, BasicRack{});
}

TEST(StandardTools, FullRadiusRacksEndInOneArc) {
  for (const char* name : {"full-radius-1.25", "full-radius-1.4"}) {
    const BasicRack& rack = find_rack(standard_tools(), name)->rack;
    // an arc that touches both flanks and the tip line: centre on the tooth's middle
    const double a = rack.pressure_angle_rad;
    const double depth = rack.dedendum - rack.root_radius;
    const double to_flank = 0.25 * kPi * std::cos(a) - depth * std::sin(a);
    EXPECT_NEAR(to_flank, rack.root_radius, 1e-12) << name;
  }
}

TEST(StandardTools, AreAllNamedOnceAndTellTheirSource) {
  std::vector<std::string> names;
  for (const RackTool& tool : standard_tools().racks) {
    names.push_back("rack " + tool.name);
    EXPECT_FALSE(tool.source.empty()) << tool.name;
  }
  for (const CutterTool& tool : standard_tools().cutters) {
    names.push_back("cutter " + tool.name);
    EXPECT_FALSE(tool.source.empty()) << tool.name;
  }
  for (const Process& process : standard_tools().processes.all()) {
    names.push_back("process " + process.name);
    EXPECT_FALSE(process.source.empty()) << process.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(ToolNames, GiveTheRackAndSingleKeysChangeIt) {
  EXPECT_EQ(read_gear(gear_file("[rack]\nprofile = \"ISO53-D\"")).rack,
            find_rack(standard_tools(), "ISO53-D")->rack);
  // whatever their order
  for (const char* keys : {"profile = \"ISO53-D\"\nroot_radius = 0.2",
                           "root_radius = 0.2\nprofile = \"ISO53-D\""}) {
    const BasicRack rack = read_gear(gear_file(std::string("[rack]\n") + keys)).rack;
    EXPECT_EQ(rack.dedendum, 1.4);
    EXPECT_EQ(rack.root_radius, 0.2);
  }
}

TEST(ToolNames, FinePitchRackIsDeeperTheSmallerTheModule) {
  const std::string rack = "[rack]\nprofile = \"AGMA-fine-pitch\"";
  EXPECT_NEAR(read_gear(gear_file(rack, 0.5)).rack.dedendum, 1.2 + 0.0508 / 0.5, 1e-12);
  EXPECT_NEAR(read_gear(gear_file(rack, 0.2)).rack.dedendum, 1.2 + 0.0508 / 0.2, 1e-12);
}

TEST(ToolNames, CutterByDiameterHasTheTeethThatFitTheModule) {
  const std::string ring = "[gearbox]\nkind = \"gear\"\nmodule_mm = 2\n[gear]\ninternal = true\n"
                           "teeth = 90\nface_width_mm = 8\nroot = \"shaper\"\n[gear.cutter]\n";
  const auto cutter = [&](const std::string& keys) {
    return *read_gear("format = 1\n" + ring + keys).gears[0].cutter;
  };
  EXPECT_EQ(cutter("name = \"disc-75\"").teeth, 38);
  EXPECT_EQ(cutter("name = \"disc-75\"").tip_radius, 0.2);
  EXPECT_EQ(cutter("name = \"disc-75\"\nteeth = 36").teeth, 36);
  EXPECT_EQ(cutter("name = \"disc-75\"\nshift = -0.1").shift, -0.1);
  EXPECT_EQ(error_of_gear("format = 1\n" + ring + "shift = 0").key, "gear.cutter.teeth");
  EXPECT_EQ(error_of_gear("format = 1\n" + ring + "name = \"disc-76\"").key, "gear.cutter.name");
}

TEST(ToolNames, UnknownOnesAreToldWithTheKnown) {
  const Error error = error_of_gear(gear_file("[rack]\nprofile = \"ISO53-E\""));
  EXPECT_EQ(error.key, "rack.profile");
  EXPECT_EQ(error.line, 6);
  EXPECT_NE(error.remedy.find("ISO53-D"), std::string::npos);
  EXPECT_EQ(error_of_gear(gear_file("[made]\nprocess = \"magic\"")).key, "made.process");
  EXPECT_EQ(error_of_gear(gear_file("made = 3")).key, "gearbox.made");
}

TEST(ToolNames, ImpossibleProtuberanceIsToldWithItsKey) {
  EXPECT_EQ(error_of_gear(gear_file("[rack]\nprotuberance = 0.05\ngrinding_stock = 0.06")).key,
            "rack.grinding_stock");
  EXPECT_EQ(error_of_gear(gear_file("[rack]\ngrinding_stock = 0.06")).key, "rack.grinding_stock");
  EXPECT_EQ(
      error_of_gear(gear_file("[rack]\nprotuberance = 0.05\nprotuberance_angle_deg = 20")).key,
      "rack.protuberance_angle_deg");
  const std::string ring = gear_file("[rack]\nprotuberance = 0.05") + "internal = true\n";
  EXPECT_EQ(error_of_gear(ring).key, "rack.protuberance");
}

TEST(ToolsFile, AddsAndReplacesByName) {
  const auto tools = read_tools_text(
      "[rack.mine]\nprofile_note = 1\n", "tools.toml");
  ASSERT_FALSE(tools);
  EXPECT_EQ(tools.error().front().key, "rack.mine.profile_note");
  EXPECT_EQ(tools.error().front().file, "tools.toml");

  const auto good = read_tools_text(
      "[rack.mine]\npressure_angle_deg = 25\ndedendum = 1.35\nprotuberance = 0.04\n"
      "[cutter.c34]\nteeth = 34\ntip_radius = 0.1\n"
      "[process.\"fdm-0.4\"]\nbacklash_mm = 0.3\n"
      "[process.own]\nnozzle_mm = 0.8\n",
      "tools.toml");
  ASSERT_TRUE(good) << good.error().front().message;
  EXPECT_NEAR(find_rack(*good, "mine")->rack.pressure_angle_rad, rad_from_deg(25.0), 1e-15);
  EXPECT_EQ(find_rack(*good, "mine")->rack.protuberance, 0.04);
  EXPECT_EQ(find_rack(*good, "mine")->rack.root_radius, 0.38);
  EXPECT_EQ(find_cutter(*good, "c34")->at_module(7.0).teeth, 34);
  // a known process keeps what is not said
  EXPECT_EQ(good->processes.find("fdm-0.4")->backlash_mm, 0.3);
  EXPECT_EQ(good->processes.find("fdm-0.4")->nozzle_mm, 0.4);
  EXPECT_EQ(good->processes.find("own")->least_wall_mm, 0.0);
}

TEST(ToolsFile, WrongOnesAreToldAllAtOnce) {
  const auto tools = read_tools_text(
      "tool = 1\n[rack]\nmine = 3\n[cutter.a]\nteeth = 30\npitch_diameter_mm = 20\n"
      "[cutter.b]\n[process.p]\nnozzle_mm = -1\n",
      "t.toml");
  ASSERT_FALSE(tools);
  std::vector<std::string> keys;
  for (const Error& error : tools.error()) keys.push_back(error.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"tool", "rack.mine", "cutter.a", "cutter.b",
                                            "process.p.nozzle_mm"}));
}

TEST(ToolsFile, OfADesignStandsBesideIt) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "own.toml") << "[rack.mine]\ndedendum = 1.3\n[process.own]\nkerf_mm = 0.2\n";
  const std::string text = "tools = \"own.toml\"\n" + gear_file("[rack]\nprofile = \"mine\"\n"
                                                                "[made]\nprocess = \"own\"");
  const auto file = read_design_file_text(text, (folder / "design.toml").string());
  ASSERT_TRUE(file) << file.error().front().message;
  EXPECT_EQ(file->design.rack.dedendum, 1.3);
  ASSERT_TRUE(file->design.made.process);
  EXPECT_EQ(file->design.made.process->kerf_mm, 0.2);
  // and the design can be written and read again there
  const auto again = read_design_file_text(design_file_text(file->design),
                                           (folder / "again.toml").string());
  ASSERT_TRUE(again) << again.error().front().message;
  GearboxDesign renamed = again->design;
  renamed.name = file->design.name;
  EXPECT_EQ(renamed, file->design);

  const auto missing = read_design_file_text("tools = \"none.toml\"\n" + gear_file(""),
                                             (folder / "design.toml").string());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().front().code, ErrorCode::kFileNotFound);
}

TEST(ToolsFile, EveryKeyAndToolIsInTheDocumentation) {
  std::ostringstream page;
  page << std::ifstream(std::string(TRUEFLANK_SOURCE_DIR) + "/docs/made.md").rdbuf();
  const std::string text = page.str();
  for (const char* kind : {"rack", "cutter", "process"})
    for (const KeyRule& rule : tool_key_rules(kind))
      EXPECT_NE(text.find("`" + std::string(rule.name) + "`"), std::string::npos) << rule.name;
  for (const RackTool& tool : standard_tools().racks)
    EXPECT_NE(text.find("`" + tool.name + "`"), std::string::npos) << tool.name;
  for (const CutterTool& tool : standard_tools().cutters)
    EXPECT_NE(text.find("`" + tool.name + "`"), std::string::npos) << tool.name;
  for (const Process& process : standard_tools().processes.all())
    EXPECT_NE(text.find("`" + process.name + "`"), std::string::npos) << process.name;
}

TEST(ThicknessKeys, ContradictionsAreTold) {
  const auto key_of = [](const std::string& keys) {
    return error_of_gear(gear_file("") + keys).key;
  };
  EXPECT_EQ(key_of("thickness_allowance = \"cd25\"\nthinning_um = 20"), "gear.thinning_um");
  EXPECT_EQ(key_of("thickness_allowance = \"cd25\"\nthickness_upper_um = -3"),
            "gear.thickness_allowance");
  EXPECT_EQ(key_of("thickness_upper_um = -3"), "gear.thickness_upper_um");
  EXPECT_EQ(key_of("thickness_upper_um = -30\nthickness_lower_um = -20"),
            "gear.thickness_lower_um");
  const GearboxDesign design =
      read_gear(gear_file("") + "thickness_upper_um = -30\nthickness_lower_um = -70\n");
  EXPECT_EQ(design.gears[0].thickness->upper_mm, -0.03);
  EXPECT_EQ(read_design_text(design_file_text(design), "a.toml")->gears, design.gears);
}

}  // namespace
}  // namespace trueflank
