// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every error of the reader, provoked once in a file that is right but for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace {

const std::string k3k = R"(format = 1
name = "drive"
[gearbox]
kind = "3k"
output = "ring2"
planets = 3
module_mm = 1.0
centre_distance_mm = 25.6826
friction = 0.1
backlash_mm = 0.05
layer_gap_mm = 1.0
helix_angle_deg = 0.0
herringbone = false
[rack]
pressure_angle_deg = 20.0
addendum = 1.0
dedendum = 1.25
root_radius = 0.38
[sun]
teeth = 12
shift = 0.0
face_width_mm = 10.0
bore_mm = 5.0
[planet1]
teeth = 39
face_width_mm = 10.0
bore_mm = 8.0
[planet1.modifications]
tip_relief_um = 8
tip_relief_start_diameter_mm = 40.5
[ring1]
teeth = 90
shift = 0.5225
face_width_mm = 10.0
outer_diameter_mm = 112.0
bolt_circle_diameter_mm = 103.0
bolt_count = 8
bolt_hole_diameter_mm = 4.5
[planet2]
teeth = 32
face_width_mm = 10.0
[ring2]
teeth = 81
shift = 1.9967
face_width_mm = 10.0
root = "shaper"
[ring2.cutter]
teeth = 25
)";

const std::string kGear = R"(format = 1
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = 20
shift = 0.0
face_width_mm = 10.0
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

int line_of(const std::string& text, const std::string& what) {
  const auto at = text.find(what);
  return at == std::string::npos
             ? 0
             : 1 + static_cast<int>(std::count(text.begin(), text.begin() + at, '\n'));
}

struct Slip {
  const char* what;   ///< of the right file
  const char* with;
  ErrorCode code;
  const char* key;
  const char* value;
  const char* remedy;  ///< part of message or remedy
  const char* place;   ///< the error's line is that of this text in the wrong file
};

void expect_slip(const std::string& right, const Slip& slip) {
  SCOPED_TRACE(std::string(slip.what) + " -> " + slip.with);
  const std::string text = replaced(right, slip.what, slip.with);
  const auto design = read_design_text(text, "slip.toml");
  ASSERT_FALSE(design);
  ASSERT_EQ(design.error().size(), 1u) << design.error()[1].message;
  const Error& error = design.error().front();
  EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(slip.code)) << error.message;
  EXPECT_EQ(error.key, slip.key);
  EXPECT_EQ(error.value, slip.value);
  const std::string cure = error.message + " " + error.remedy;
  EXPECT_NE(cure.find(slip.remedy), std::string::npos) << cure;
  EXPECT_EQ(error.line, line_of(text, slip.place)) << error.message;
  EXPECT_EQ(error.file, "slip.toml");
  EXPECT_FALSE(error.message.empty());
  EXPECT_EQ(exit_code(error.code), 2);
}

constexpr auto kSyntax = ErrorCode::kSyntax;
constexpr auto kUnknown = ErrorCode::kUnknownKey;
constexpr auto kMissing = ErrorCode::kMissingKey;
constexpr auto kType = ErrorCode::kWrongType;
constexpr auto kRange = ErrorCode::kOutOfRange;
constexpr auto kAgainst = ErrorCode::kInconsistent;

TEST(DesignErrors, TheFilesTheyAreProvokedInAreRight) {
  for (const std::string& text : {k3k, kGear}) {
    const auto design = read_design_text(text, "right.toml");
    EXPECT_TRUE(design) << design.error().front().message;
  }
}

TEST(DesignErrors, WrongFormatIsRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"format = 1\n", "", kMissing, "format", "", "1", "name"},
           {"format = 1", "format = 2", kRange, "format", "2", "1", "format"},
           {"format = 1", "format = 0", kRange, "format", "0", "1", "format"},
           {"format = 1", "format = \"1\"", kType, "format", "\"1\"", "1", "format"},
           {"format = 1", "format = 1.0", kType, "format", "1.0", "1", "format"}})
    expect_slip(k3k, slip);
}

TEST(DesignErrors, UnknownKeysNameTheNearestKnownOne) {
  for (const Slip& slip : std::vector<Slip>{
           {"name =", "nmae =", kUnknown, "nmae", "\"drive\"", "mean name?", "nmae"},
           {"friction", "fricton", kUnknown, "gearbox.fricton", "0.1", "mean friction?", "fricton"},
           {"centre_distance_mm", "center_distance_mm", kUnknown, "gearbox.center_distance_mm",
            "25.6826", "mean centre_distance_mm?", "center"},
           {"layer_gap_mm", "layer_gap", kUnknown, "gearbox.layer_gap", "1.0",
            "mean layer_gap_mm?", "layer_gap"},
           {"root_radius", "Root_Radius", kUnknown, "rack.Root_Radius", "0.38",
            "mean root_radius?", "Root_Radius"},
           {"tip_relief_um", "tip_releif_um", kUnknown, "planet1.modifications.tip_releif_um", "8",
            "mean tip_relief_um?", "tip_releif"},
           {"addendum", "friction", kUnknown, "rack.friction", "1.0", "belongs to [gearbox]",
            "friction = 1.0"},
           {"name =", "teeth =", kUnknown, "teeth", "\"drive\"", "belongs to a gear's table",
            "teeth = \"drive\""},
           {"planets = 3", "planets = 3\nzzzzzzzz = 1", kUnknown, "gearbox.zzzzzzzz", "1",
            "unknown key kind, output", "zzzzzzzz"},
           {"[rack]", "[engine]\n[rack]", kUnknown, "engine", "a table", "format, name, tools, sun",
            "[engine]"}}) {
    SCOPED_TRACE(slip.with);
    const auto design = read_design_text(replaced(k3k, slip.what, slip.with), "slip.toml");
    ASSERT_FALSE(design);
    const auto it = std::find_if(design.error().begin(), design.error().end(),
                                 [&](const Error& error) { return error.key == slip.key; });
    ASSERT_NE(it, design.error().end());
    EXPECT_EQ(static_cast<int>(it->code), static_cast<int>(slip.code));
    EXPECT_EQ(it->value, slip.value);
    const std::string cure = it->message + " " + it->remedy;
    EXPECT_NE(cure.find(slip.remedy), std::string::npos) << cure;
    EXPECT_EQ(it->line, line_of(replaced(k3k, slip.what, slip.with), slip.place));
  }
}

TEST(DesignErrors, WrongTypesAndImpossibleValuesAreRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"\"drive\"", "7", kType, "name", "7", "text", "name"},
           {"\"drive\"", "\"\"", kRange, "name", "\"\"", "100 characters", "name"},
           {"\"drive\"", R"("a\u001Bb")", kRange, "name", R"("a\u001Bb")", "100", "name"},
           {"kind = \"3k\"", "kind = 3", kType, "gearbox.kind", "3", "one of \"3k\"", "kind"},
           {"kind = \"3k\"", "kind = \"3K\"", kRange, "gearbox.kind", "\"3K\"", "\"simple\"",
            "kind"},
           {"planets = 3", "planets = 0", kRange, "gearbox.planets", "0", "from 1 to 50",
            "planets"},
           {"planets = 3", "planets = 2.5", kType, "gearbox.planets", "2.5", "whole", "planets"},
           {"module_mm = 1.0", "module_mm = 0", kRange, "gearbox.module_mm", "0", "from 0.01",
            "module_mm"},
           {"module_mm = 1.0", "module_mm = -1", kRange, "gearbox.module_mm", "-1", "to 100 mm",
            "module_mm"},
           {"module_mm = 1.0", "module_mm = \"1\"", kType, "gearbox.module_mm", "\"1\"", "a number",
            "module_mm"},
           {"module_mm = 1.0", "module_mm = [1.0]", kType, "gearbox.module_mm", "an array",
            "a number", "module_mm"},
           {"module_mm = 1.0", "module_mm = 1979-05-27", kType, "gearbox.module_mm",
            "a date or time", "a number", "module_mm"},
           {"friction = 0.1", "friction = nan", kRange, "gearbox.friction", "nan", "from 0 to 1",
            "friction"},
           {"friction = 0.1", "friction = -inf", kRange, "gearbox.friction", "-inf", "from 0 to 1",
            "friction"},
           {"friction = 0.1", "friction = true", kType, "gearbox.friction", "true", "a number",
            "friction"},
           {"backlash_mm = 0.05", "backlash_mm = -0.05", kRange, "gearbox.backlash_mm", "-0.05",
            "from 0", "backlash"},
           {"herringbone = false", "herringbone = 0", kType, "gearbox.herringbone", "0",
            "true or false", "herringbone"},
           {"helix_angle_deg = 0.0", "helix_angle_deg = 90", kRange, "gearbox.helix_angle_deg",
            "90", "-60 to 60 deg", "helix"},
           {"pressure_angle_deg = 20.0", "pressure_angle_deg = 0.35", kRange,
            "rack.pressure_angle_deg", "0.35", "from 5 to 44 deg", "pressure"},
           {"pressure_angle_deg = 20.0", "pressure_angle_deg = 45", kRange,
            "rack.pressure_angle_deg", "45", "from 5 to 44 deg", "pressure"},
           {"pressure_angle_deg = 20.0", "pressure_angle_deg = 50", kRange,
            "rack.pressure_angle_deg", "50", "from 5 to 44 deg", "pressure"},
           {"addendum = 1.0", "addendum = 10", kRange, "rack.addendum", "10", "times the module",
            "addendum"},
           {"teeth = 12", "teeth = 4", kRange, "sun.teeth", "4", "from 5 to 500", "teeth = 4"},
           {"teeth = 12", "teeth = 9223372036854775807", kRange, "sun.teeth",
            "9223372036854775807", "5 to 500", "teeth = 92"},
           {"teeth = 12", "teeth = -12", kRange, "sun.teeth", "-12", "5 to 500", "teeth = -12"},
           {"teeth = 90", "teeth = 1501", kRange, "ring1.teeth", "1501", "to 1500", "teeth = 1501"},
           {"shift = 0.5225", "shift = 52.25", kRange, "ring1.shift", "52.25", "from -10 to 10",
            "shift = 52"},
           {"root = \"shaper\"", "root = \"Shaper\"", kRange, "ring2.root", "\"Shaper\"",
            "\"fillet\", \"shaper\"", "root ="},
           {"[ring2.cutter]\nteeth = 25\n", "cutter = 25\n", kType, "ring2.cutter", "25", "a table",
            "cutter ="},
           {"[planet1.modifications]\ntip_relief_um = 8\ntip_relief_start_diameter_mm = 40.5\n",
            "modifications = []\n", kType, "planet1.modifications", "an array", "a table",
            "modifications"}})
    expect_slip(k3k, slip);
  expect_slip(kGear, {"[gear]\nteeth = 20\nshift = 0.0\nface_width_mm = 10.0\n", "[[gear]]\n",
                      kType, "gear", "an array", "a table", "[[gear]]"});
}

TEST(DesignErrors, MissingKeysAndTablesAreNamed) {
  for (const Slip& slip : std::vector<Slip>{
           {"output = \"ring2\"\n", "", kMissing, "gearbox.output", "", "\"ring2\"", "[gearbox]"},
           {"planets = 3\n", "", kMissing, "gearbox.planets", "", "1 to 50", "[gearbox]"},
           {"module_mm = 1.0\n", "", kMissing, "gearbox.module_mm", "", "module", "[gearbox]"},
           {"teeth = 12\n", "", kMissing, "sun.teeth", "", "5 to 500", "[sun]"},
           {"face_width_mm = 10.0\nbore_mm = 8.0\n", "bore_mm = 8.0\n", kMissing,
            "planet1.face_width_mm", "", "mm", "[planet1]"},
           {"[planet2]\nteeth = 32\nface_width_mm = 10.0\n", "", kMissing, "planet2", "",
            "the gears sun, planet1, ring1, planet2, ring2", "kind"},
           {"teeth = 25\n", "", kMissing, "ring2.cutter.teeth", "", "5 to 500", "[ring2.cutter]"},
           {"[ring2.cutter]\nteeth = 25\n", "", kMissing, "ring2.cutter", "", "[ring2.cutter]",
            "[ring2]"},
           {"tip_relief_start_diameter_mm = 40.5\n", "", kMissing,
            "planet1.modifications.tip_relief_start_diameter_mm", "", "diameter",
            "[planet1.modifications]"},
           {"tip_relief_um = 8\n", "tip_relief_um = 8\nend_relief_um = 4\n", kMissing,
            "planet1.modifications.end_relief_length_mm", "", "reaches in",
            "[planet1.modifications]"},
           {"tip_relief_um = 8\n", "tip_relief_um = 8\nroot_relief_um = 4\n", kMissing,
            "planet1.modifications.root_relief_start_diameter_mm", "", "diameter",
            "[planet1.modifications]"},
           {"bolt_count = 8\n", "", kMissing, "ring1.bolt_count", "", "all of", "[ring1]"}})
    expect_slip(k3k, slip);
  const auto design = read_design_text("format = 1\nname = \"x\"\n", "empty.toml");
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().size(), 1u);
  EXPECT_EQ(design.error().front().key, "gearbox");
}

TEST(DesignErrors, MissingKindIsToldWithoutGuessingWhichGearsThereAre) {
  expect_slip(k3k,
              {"kind = \"3k\"\n", "", kMissing, "gearbox.kind", "", "\"simple\"", "[gearbox]"});
}

TEST(DesignErrors, ValuesThatContradictEachOtherAreRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"output = \"ring2\"", "output = \"carrier\"", kAgainst, "gearbox.output", "\"carrier\"",
            "\"ring2\" or \"ring1\"", "output"},
           {"[rack]", "[pinion]\n[rack]", kAgainst, "pinion", "a table", "the gears sun",
            "[pinion]"},
           {"herringbone = false", "herringbone = true", kAgainst, "gearbox.herringbone", "true",
            "helix_angle_deg", "herringbone"},
           {"backlash_mm = 0.05", "backlash_mm = 5", kAgainst, "gearbox.backlash_mm", "5",
            "at most 1 mm", "backlash"},
           {"teeth = 90\n", "teeth = 90\nmodule_mm = 2.0\n", kAgainst, "ring1.module_mm", "2.0",
            "one module", "module_mm = 2.0"},
           {"teeth = 39\n", "teeth = 100\n", kAgainst, "ring1.teeth", "90", "more than 100",
            "teeth = 90"},
           {"teeth = 81", "teeth = 32", kAgainst, "ring2.teeth", "32", "more than 32",
            "teeth = 32\nshift = 1.9967"},
           {"teeth = 12\n", "teeth = 12\nthinning_um = 2000\n", kAgainst, "sun.thinning_um", "2000",
            "at most 1000 um", "thinning"},
           {"teeth = 12\n", "teeth = 12\ntip_diameter_mm = 9\n", kAgainst, "sun.tip_diameter_mm",
            "9", "more than 9.5 mm", "tip_diameter_mm = 9"},
           {"teeth = 90\n", "teeth = 90\ntip_diameter_mm = 95\n", kAgainst, "ring1.tip_diameter_mm",
            "95", "less than 93.545 mm", "tip_diameter_mm = 95"},
           {"tip_relief_um = 8\n", "", kAgainst,
            "planet1.modifications.tip_relief_start_diameter_mm", "40.5", "tip_relief_um",
            "tip_relief_start"},
           {"teeth = 39\n", "teeth = 39\ntip_diameter_mm = 40\n", kAgainst,
            "planet1.modifications.tip_relief_start_diameter_mm", "40.5", "less than 40 mm",
            "tip_relief_start"},
           {"tip_relief_um = 8\n", "tip_relief_um = 8\nedge_chamfer_mm = 5\n", kAgainst,
            "planet1.modifications.edge_chamfer_mm", "5", "less than 5 mm", "edge"},
           {"tip_relief_um = 8\n", "tip_relief_um = 8\nend_relief_shape = \"linear\"\n", kAgainst,
            "planet1.modifications.end_relief_shape", "\"linear\"", "end_relief_um", "end_relief"},
           {"tip_relief_um = 8\n",
            "tip_relief_um = 8\nend_relief_um = 4\nend_relief_length_mm = 6\n", kAgainst,
            "planet1.modifications.end_relief_length_mm", "6", "at most 5 mm", "end_relief_length"},
           {"herringbone = false", "relief_groove_mm = 2", kAgainst, "gearbox.relief_groove_mm", "2",
            "herringbone = true", "relief_groove"},
           {"helix_angle_deg = 0.0\nherringbone = false",
            "helix_angle_deg = 5.0\nherringbone = true\nrelief_groove_mm = 10", kAgainst,
            "gearbox.relief_groove_mm", "10", "less than its face width, 10 mm", "relief_groove"}})
    expect_slip(k3k, slip);
  expect_slip(kGear, {"module_mm = 1.0", "module_mm = 1.0\nplanets = 3", kAgainst,
                      "gearbox.planets", "3", "no such key", "planets"});
  expect_slip(kGear, {"module_mm = 1.0", "module_mm = 1.0\noutput = \"wheel\"", kAgainst,
                      "gearbox.output", "\"wheel\"", "no output", "output"});
  expect_slip(kGear, {"module_mm = 1.0", "module_mm = 1.0\ncentre_distance_mm = 20", kAgainst,
                      "gearbox.centre_distance_mm", "20", "pair", "centre"});
}

TEST(DesignErrors, ModulesMustAgreeWithinALayerOnly) {
  const auto other = [&](const std::string& text, const char* gear) {
    const std::string header = "[" + std::string(gear) + "]\n";
    return replaced(text, header, header + "module_mm = 1.25\n");
  };
  EXPECT_TRUE(read_design_text(other(other(k3k, "planet2"), "ring2"), "layers.toml"));
  EXPECT_FALSE(read_design_text(other(k3k, "planet2"), "layers.toml"));
}

TEST(DesignErrors, ModuleMayBeLeftOutWhereEveryGearHasItsOwn) {
  std::string text = replaced(kGear, "module_mm = 1.0\n", "");
  EXPECT_FALSE(read_design_text(text, "own.toml"));
  text = replaced(text, "teeth = 20", "teeth = 20\nmodule_mm = 0.8");
  const auto design = read_design_text(text, "own.toml");
  ASSERT_TRUE(design);
  EXPECT_EQ(module_of(*design, design->gears[0]), 0.8);
}

TEST(DesignErrors, BoresThatCannotBeAreRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"shift", "bore_d_flat_mm = 4\nshift", kAgainst, "gear.bore_d_flat_mm", "4", "bore_mm",
            "bore_d"},
           {"shift", "bore_mm = 5\nbore_d_flat_mm = 2.4\nshift", kAgainst, "gear.bore_d_flat_mm",
            "2.4", "more than 2.5 mm and less than 5 mm", "bore_d"},
           {"shift", "bore_mm = 5\nbore_d_flat_mm = 5\nshift", kAgainst, "gear.bore_d_flat_mm", "5",
            "less than 5 mm", "bore_d"},
           {"shift", "bore_mm = 5\nbore_hex_mm = 5\nshift", kAgainst, "gear.bore_hex_mm", "5",
            "one of the two", "bore_hex"},
           {"shift", "bore_hex_mm = 5\nbore_d_flat_mm = 4\nshift", kAgainst, "gear.bore_d_flat_mm",
            "4", "one of the two", "bore_d"},
           {"shift", "bore_mm = 5\nbore_keyway_width_mm = 2\nshift", kMissing,
            "gear.bore_keyway_depth_mm", "", "both", "[gear]"},
           {"shift", "bore_mm = 5\nbore_keyway_depth_mm = 1\nshift", kMissing,
            "gear.bore_keyway_width_mm", "", "both", "[gear]"},
           {"shift", "bore_mm = 5\nbore_keyway_width_mm = 5\nbore_keyway_depth_mm = 1\nshift",
            kAgainst, "gear.bore_keyway_width_mm", "5", "less than 5 mm", "bore_keyway_w"},
           {"shift",
            "bore_mm = 5\nbore_keyway_width_mm = 2\nbore_keyway_depth_mm = 1\nbore_d_flat_mm = "
            "4\nshift",
            kAgainst, "gear.bore_d_flat_mm", "4", "one of the two", "bore_d"},
           {"shift", "bore_mm = 17.5\nshift", kAgainst, "gear.bore_mm", "17.5", "inside",
            "bore_mm"},
           {"shift", "bore_hex_mm = 15.2\nshift", kAgainst, "gear.bore_hex_mm", "15.2", "inside",
            "bore_hex"},
           {"shift", "bore_mm = 16\nbore_keyway_width_mm = 5\nbore_keyway_depth_mm = 0.7\nshift",
            kAgainst, "gear.bore_mm", "16", "inside", "bore_mm"}})
    expect_slip(kGear, slip);
  // the same bores a little smaller are right
  for (const char* bore : {"bore_mm = 17.4\n", "bore_hex_mm = 15.1\n",
                           "bore_mm = 15\nbore_keyway_width_mm = 5\nbore_keyway_depth_mm = 0.7\n",
                           "bore_mm = 5\nbore_d_flat_mm = 4.5\n"})
    EXPECT_TRUE(read_design_text(kGear + bore, "bore.toml")) << bore;
  expect_slip(k3k, {"teeth = 32\n", "teeth = 32\nbore_mm = 9.0\n", kAgainst, "planet2.bore_mm",
                    "9.0", "[planet1] alone", "bore_mm = 9"});
  EXPECT_TRUE(read_design_text(replaced(k3k, "teeth = 32\n", "teeth = 32\nbore_mm = 8.0\n"), ""));
}

TEST(DesignErrors, RimsAndBoltsThatCannotBeAreRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"outer_diameter_mm = 112.0", "outer_diameter_mm = 90", kAgainst,
            "ring1.outer_diameter_mm", "90", "more than 93.545 mm", "outer"},
           {"bolt_circle_diameter_mm = 103.0", "bolt_circle_diameter_mm = 97.5", kAgainst,
            "ring1.bolt_circle_diameter_mm", "97.5", "more than 98.045 mm", "bolt_circle"},
           {"bolt_circle_diameter_mm = 103.0", "bolt_circle_diameter_mm = 108", kAgainst,
            "ring1.bolt_circle_diameter_mm", "108", "less than 107.5 mm", "bolt_circle"},
           {"bolt_count = 8", "bolt_count = 72", kAgainst, "ring1.bolt_hole_diameter_mm", "4.5",
            "less than 4.49", "bolt_hole"}}) {
    if (std::string(slip.key) == "ring1.outer_diameter_mm") {
      const std::string no_bolts = replaced(
          k3k,
          "bolt_circle_diameter_mm = 103.0\nbolt_count = 8\nbolt_hole_diameter_mm = 4.5\n", "");
      expect_slip(no_bolts, slip);
    } else {
      expect_slip(k3k, slip);
    }
  }
}

TEST(DesignErrors, KeysOfTheOtherSortOfGearAreRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"teeth = 12\n", "teeth = 12\nouter_diameter_mm = 20\n", kAgainst,
            "sun.outer_diameter_mm", "20", "no such key", "outer_diameter_mm = 20"},
           {"teeth = 90\n", "teeth = 90\nbore_mm = 20\n", kAgainst, "ring1.bore_mm", "20",
            "no such key", "bore_mm = 20"},
           {"teeth = 90\n", "teeth = 90\ninternal = true\n", kAgainst, "ring1.internal", "true",
            "only a wheel", "internal"},
           {"[planet2]", "[planet1.cutter]\nteeth = 20\n[planet2]", kAgainst, "planet1.cutter",
            "a table", "no such table", "[planet1.cutter]"},
           {"root = \"shaper\"\n", "", kAgainst, "ring2.cutter", "a table", "root = \"shaper\"",
            "[ring2.cutter]"},
           {"teeth = 25", "teeth = 81", kAgainst, "ring2.cutter.teeth", "81", "fewer than 81",
            "[ring2.cutter]\n"}}) {
    if (std::string(slip.key) == "ring2.cutter.teeth") {
      const auto design = read_design_text(replaced(k3k, slip.what, slip.with), "slip.toml");
      ASSERT_FALSE(design);
      EXPECT_EQ(design.error().front().key, slip.key);
    } else {
      expect_slip(k3k, slip);
    }
  }
  expect_slip(kGear, {"shift", "root = \"fillet\"\nshift", kAgainst, "gear.root", "\"fillet\"",
                      "internal = true", "root"});
  EXPECT_TRUE(read_design_text(replaced(kGear, "shift", "internal = true\nshift"), ""));
}

TEST(DesignErrors, WrongTomlIsToldWithLineKeyAndValue) {
  for (const Slip& slip : std::vector<Slip>{
           {"teeth = 12", "teeth = 12\nteeth = 13", kSyntax, "sun.teeth", "13", "one of the two",
            "teeth = 13"},
           {"[planet2]", "[sun]\n[planet2]", kSyntax, "sun", "[sun]", "one of the two",
            "[sun]\n[planet2]"},
           {"kind = \"3k\"", "kind = 3k", kSyntax, "gearbox.kind", "3k", "in quotes: \"3k\"",
            "kind"},
           {"module_mm = 1.0", "module_mm = 1,0", kSyntax, "gearbox.module_mm", "1,0",
            "a decimal point", "module"},
           {"bore_mm = 5.0", "bore_mm = 5.0 mm", kSyntax, "sun.bore_mm", "5.0 mm", "no unit",
            "bore_mm"},
           {"module_mm = 1.0", "module_mm =", kSyntax, "gearbox.module_mm", "", "a number",
            "module"},
           {"\"drive\"", "\"drive", kSyntax, "name", "\"drive", "a closing \"", "name"},
           {"layer_gap_mm = 1.0", "layer_gap_mm 1.0", kSyntax, "gearbox.layer_gap_mm",
            "layer_gap_mm 1.0", "key = value", "layer_gap"},
           {"layer_gap_mm = 1.0", "größe = 1.0", kSyntax, "gearbox", "größe = 1.0", "a-z", "größe"},
           {"shift = 0.5225", "shift = +0.5.225", kSyntax, "ring1.shift", "+0.5.225", "a number",
            "shift = +"},
           {"[rack]", "[rack", kSyntax, "rack", "[rack", "[name]", "[rack"}})
    expect_slip(k3k, slip);
}

TEST(DesignErrors, OfTomlDoNotHideTheOthers) {
  std::string text = replaced(k3k, "kind = \"3k\"", "kind = 3k");
  text = replaced(text, "friction = 0.1", "friction = 0,1");
  text = replaced(text, "teeth = 12", "teeth = 4");
  text = replaced(text, "[ring2.cutter]", "[ring2.cutter");
  text = replaced(text, "addendum", "adendum");
  const auto design = read_design_text(text, "many.toml");
  ASSERT_FALSE(design);
  std::string keys;
  for (const Error& error : design.error()) keys += error.key + " ";
  EXPECT_EQ(keys, "gearbox.kind gearbox.friction rack.adendum sun.teeth ring2.cutter ");
}

TEST(DesignErrors, ManyAreToldAtOnceEachOnce) {
  std::string text = k3k;
  for (const char* number : {"friction = 0.1", "backlash_mm = 0.05", "addendum = 1.0"})
    text = replaced(text, number, std::string(number).substr(0, 5) + "x = 1");
  text = replaced(text, "teeth = 12", "teeth = \"12\"");
  text = replaced(text, "root = \"shaper\"", "root = 1");
  const auto design = read_design_text(text, "many.toml");
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().size(), 5u);
  EXPECT_TRUE(std::is_sorted(design.error().begin(), design.error().end(),
                             [](const Error& a, const Error& b) { return a.line < b.line; }));
}

TEST(DesignErrors, OfLaterStationsFindTheirLine) {
  const auto file = read_design_file_text(k3k, "drive.toml");
  ASSERT_TRUE(file);
  const Errors errors = located({{.message = "a", .key = "ring2.shift"},
                                 {.message = "b", .key = "ring2.tip_diameter_mm"},
                                 {.message = "c", .key = "nowhere"}},
                                *file);
  EXPECT_EQ(errors[0].line, line_of(k3k, "shift = 1.9967"));
  EXPECT_EQ(errors[1].line, line_of(k3k, "[ring2]"));
  EXPECT_EQ(errors[2].line, 0);
  for (const Error& error : errors) EXPECT_EQ(error.file, "drive.toml");
}

}  // namespace
}  // namespace trueflank
