// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_edit.h"

#include <gtest/gtest.h>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"

namespace trueflank {
namespace {

const char* const kText = R"(# my pair
format = 1
name = "edited"

[gearbox]          # of everything
kind = "pair"
module_mm = 1.0
centre_distance_mm = 30.0   # as the housing has it
backlash_mm=0.05

[pinion]
teeth = 20
face_width_mm = 10
shift = 0.1   # more than nothing
# a comment of its own

[wheel]
teeth = 40
face_width_mm = 10
tip_diameter_mm = 42.0 # "turned" # twice
)";

GearboxDesign read(const std::string& text) {
  auto design = read_design_text(text, "edited.toml");
  EXPECT_TRUE(design.has_value()) << text << design.error().front().message;
  return design ? *design : GearboxDesign{};
}

TEST(DesignEdit, ChangesValuesAndKeepsEveryComment) {
  GearboxDesign design = read(kText);
  design.centre_distance_mm = 30.25;
  design.gears[0].shift = 0.35;
  design.gears[1].tip_diameter_mm = 41.875;
  design.backlash_mm = 0.1;
  design.tips = TipCircles::kStandard;
  const auto text = edited_design_text(kText, "edited.toml", design);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(read(*text), design);
  for (const char* line : {"# my pair\n", "[gearbox]          # of everything\n",
                           "centre_distance_mm = 30.25  # as the housing has it\n", "backlash_mm=0.1\n",
                           "shift = 0.35  # more than nothing\n", "# a comment of its own\n",
                           "tip_diameter_mm = 41.875 # \"turned\" # twice\n"})
    EXPECT_NE(text->find(line), std::string::npos) << line << *text;
}

TEST(DesignEdit, KeysThatNameTheirTableStayInTheirLine) {
  const std::string dotted =
      "format = 1\r\ngearbox.kind = \"pair\"\r\ngearbox.module_mm = 1.0 # bought\r\n"
      "pinion.teeth = 20\r\npinion.face_width_mm = 10\r\nwheel.teeth = 40 # kept\r\n"
      "wheel.face_width_mm = 10\r\n";
  GearboxDesign design = read(dotted);
  design.gears[0].teeth = 21;
  design.gears[1].tip_diameter_mm = 41.875;
  const auto text = edited_design_text(dotted, "edited.toml", design);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(*text,
            "format = 1\r\ngearbox.kind = \"pair\"\r\ngearbox.module_mm = 1.0 # bought\r\n"
            "pinion.teeth = 21\r\npinion.face_width_mm = 10\r\nwheel.teeth = 40 # kept\r\n"
            "wheel.face_width_mm = 10\r\nwheel.tip_diameter_mm = 41.875\r\n");
}

TEST(DesignEdit, ATableThatLosesItsOnlyKeyIsKeptByAnotherKey) {
  const std::string dotted =
      "format = 1\ngearbox.kind = \"simple\" # of three\ngearbox.module_mm = 2\ngearbox.planets = 3\nsun.teeth = 26\n"
      "sun.face_width_mm = 20\nplanet.teeth = 13\nplanet.face_width_mm = 20\nring.teeth = 52\n"
      "ring.face_width_mm = 20\nmade.process = \"fdm-0.4\"\nmotor.name = \"nema17\"\nbearings.output = \"6808\"\n"
      "bearings.planet = \"625\"\noutput.speed_rpm = 6\ngearbox.output = \"ring\"\nhousing.outer_diameter_mm=129.5 # as the frame has it\n";
  const auto whole = read_design_text(dotted, "edited.toml");
  ASSERT_TRUE(whole.has_value()) << whole.error()[0].message;
  GearboxDesign design = *whole;
  ASSERT_TRUE(design.machine.has_value());
  design.machine->housing.outer_diameter_mm.reset();
  const auto edited = edited_design(dotted, "edited.toml", design);
  ASSERT_TRUE(edited.has_value());
  EXPECT_NE(edited->text.find("# of three"), std::string::npos);
  EXPECT_NE(edited->text.find("# housing.outer_diameter_mm=129.5 # as the frame has it\n"), std::string::npos);
  ASSERT_EQ(edited->written_out.size(), 1u);
  EXPECT_EQ(edited->written_out[0].table, "housing");
  EXPECT_NE(edited->text.find(edited->written_out[0].key + " = " + edited->written_out[0].after), std::string::npos);
  EXPECT_TRUE(read(edited->text) == design);
}

TEST(DesignEdit, NewKeysNameTheirTableBesideInchesToo) {
  const std::string dotted =
      "format = 1\ngearbox.kind = \"pair\"\ngearbox.module_in = 0.05\npinion.teeth = 20\npinion.face_width_in = 0.4\n"
      "pinion.bore_in = 0.2 # reamed\nwheel.teeth = 40\nwheel.face_width_in = 0.4\n";
  GearboxDesign design = read(dotted);
  design.gears[0].shift = 0.25;
  const auto text = edited_design_text(dotted, "edited.toml", design);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(*text,
            "format = 1\ngearbox.kind = \"pair\"\ngearbox.module_in = 0.05\npinion.teeth = 20\npinion.face_width_in = 0.4\n"
            "pinion.bore_in = 0.2 # reamed\npinion.shift = 0.25\nwheel.teeth = 40\nwheel.face_width_in = 0.4\n");
}

TEST(DesignEdit, WritesNewKeysIntoTheirTableAndNewTablesAtTheEnd) {
  GearboxDesign design = read(kText);
  design.gears[0].tip_diameter_mm = 21.75;
  design.rack.root_radius = 0.28;
  const auto text = edited_design_text(kText, "edited.toml", design);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(read(*text), design);
  EXPECT_NE(text->find("shift = 0.1   # more than nothing\ntip_diameter_mm = 21.75\n"), std::string::npos) << *text;
  EXPECT_TRUE(text->ends_with("\n[rack]\nroot_radius = 0.28\n")) << *text;
}

TEST(DesignEdit, AKeyThatIsNoLongerWrittenBecomesAComment) {
  GearboxDesign design = read(kText);
  design.gears[0].shift.reset();
  const auto text = edited_design_text(kText, "edited.toml", design);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(read(*text), design);
  EXPECT_NE(text->find("# shift = 0.1   # more than nothing\n"), std::string::npos) << *text;
}

TEST(DesignEdit, AnInlineTableIsWrittenAnewRatherThanWrong) {
  const std::string text = "format = 1\ngearbox = {kind = \"gear\", module_mm = 1.0}\ngear = {teeth = 20, shift = 0.0, face_width_mm = 8}\n";
  GearboxDesign design = read(text);
  design.gears[0].shift = 0.25;
  const auto edited = edited_design_text(text, "edited.toml", design);
  ASSERT_TRUE(edited.has_value());
  EXPECT_EQ(read(*edited), design);
}

TEST(DesignEdit, NothingChangedIsTheSameText) {
  EXPECT_EQ(*edited_design_text(kText, "edited.toml", read(kText)), kText);
}

TEST(DesignEdit, ChangesAreToldByTheirKeys) {
  const GearboxDesign before = read(kText);
  GearboxDesign after = before;
  after.gears[0].shift = 0.2;
  after.gears[1].tip_diameter_mm.reset();
  const auto changes = design_changes(before, after);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].dotted(), "pinion.shift");
  EXPECT_EQ(changes[0].before, "0.1");
  EXPECT_EQ(changes[0].after, "0.2");
  EXPECT_EQ(changes[1].dotted(), "wheel.tip_diameter_mm");
  EXPECT_EQ(changes[1].after, "");
}

TEST(InchKeys, StandForMillimetres) {
  const GearboxDesign design = read(
      "format = 1\n[gearbox]\nkind = \"pair\"\ndiametral_pitch = 24\ncentre_distance_in = 1.25\n"
      "[pinion]\nteeth = 20\nface_width_in = 0.5\nbore_in = 0.25\n[wheel]\nteeth = 40\nface_width_mm = 12\n");
  EXPECT_DOUBLE_EQ(design.module_mm, 25.4 / 24);
  EXPECT_DOUBLE_EQ(*design.centre_distance_mm, 31.75);
  EXPECT_DOUBLE_EQ(design.gears[0].face_width_mm, 12.7);
  EXPECT_DOUBLE_EQ(design.gears[0].bore.diameter_mm, 6.35);
  EXPECT_EQ(design.gears[1].face_width_mm, 12.0);
}

TEST(InchKeys, AreDecimalInMillimetresToo) {
  const GearboxDesign design = read(
      "format = 1\n[gearbox]\nkind = \"gear\"\ndiametral_pitch = 24\n[gear]\nteeth = 20\nface_width_in = 0.09\n");
  EXPECT_EQ(design.gears[0].face_width_mm, 2.286);  // 0.09 times 25.4 is a last bit less
}

TEST(InchKeys, ErrorsNameTheKeyAsItIsWritten) {
  const auto wrong = read_design_text(
      "format = 1\n[gearbox]\nkind = \"pair\"\ndiametral_pitch = 0.1\nmodule_mm = 1\n"
      "[pinion]\nteeth = 20\nface_width_in = -2\n[wheel]\nface_width_mm = 8\nteeth = 40\nfoo_in = 3\n", "x.toml");
  ASSERT_FALSE(wrong.has_value());
  ASSERT_EQ(wrong.error().size(), 3U);
  EXPECT_EQ(wrong.error()[0].key, "gearbox.diametral_pitch");
  EXPECT_EQ(wrong.error()[0].code, ErrorCode::kInconsistent);
  EXPECT_EQ(wrong.error()[0].line, 4);
  EXPECT_EQ(wrong.error()[1].key, "pinion.face_width_in");
  EXPECT_EQ(wrong.error()[1].value, "-2");
  EXPECT_EQ(wrong.error()[1].line, 8);
  EXPECT_EQ(wrong.error()[2].key, "wheel.foo_in");
  EXPECT_EQ(wrong.error()[2].code, ErrorCode::kUnknownKey);
}

TEST(InchKeys, OfAnotherTypeAreWrongValuesAndNoUnknownKeys) {
  const auto wrong = read_design_text(
      "format = 1\n[gearbox]\nkind = \"gear\"\ndiametral_pitch = \"24\"\n"
      "[gear]\nteeth = 20\nface_width_in = true\nbore_in = [1]\n", "x.toml");
  ASSERT_FALSE(wrong.has_value());
  ASSERT_EQ(wrong.error().size(), 3U);
  const std::pair<const char*, const char*> expected[] = {
      {"gearbox.diametral_pitch", "\"24\""}, {"gear.face_width_in", "true"}, {"gear.bore_in", "an array"}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(wrong.error()[i].code, ErrorCode::kWrongType);
    EXPECT_EQ(wrong.error()[i].key, expected[i].first);
    EXPECT_EQ(wrong.error()[i].value, expected[i].second);
    EXPECT_EQ(wrong.error()[i].message.find("taken as"), std::string::npos) << wrong.error()[i].message;
  }
}

TEST(InchKeys, AreKeptByAnEditThatDoesNotTouchThem) {
  const std::string text =
      "format = 1\nname = \"inch\"\n[gearbox]\nkind = \"pair\"\ndiametral_pitch = 24 # ours\ncentre_distance_in = 1.25 # wide\n"
      "[pinion]\nteeth = 20\nface_width_mm = 8\n[wheel]\nteeth = 40\nface_width_mm = 8\n";
  GearboxDesign design = read(text);
  design.centre_distance_mm = 31.5;
  const auto edited = edited_design_text(text, "inch.toml", design);
  ASSERT_TRUE(edited.has_value());
  EXPECT_EQ(read(*edited), design);
  EXPECT_NE(edited->find("diametral_pitch = 24 # ours\n"), std::string::npos) << *edited;
  EXPECT_NE(edited->find("centre_distance_mm = 31.5 # wide\n"), std::string::npos) << *edited;
}

TEST(StrengthTable, IsReadAndWritten) {
  const std::string head = "format = 1\nname = \"s\"\n[gearbox]\nkind = \"pair\"\nmodule_mm = 1\n[pinion]\nteeth = 20\nface_width_mm = 8\n[wheel]\nteeth = 40\nface_width_mm = 8\n";
  const GearboxDesign design = read(head + "[strength]\nreversing = true\nbending_safety = 1.5\noverload_factor = 1.25\n");
  EXPECT_EQ(design.strength.reversing, true);
  EXPECT_EQ(design.strength.bending_safety, 1.5);
  EXPECT_EQ(design.strength.overload_factor, 1.25);
  EXPECT_EQ(design.strength.contact_safety, 1.15);
  EXPECT_EQ(read(design_file_text(design)), design);
}

TEST(StrengthTable, HoldsSpeedLifeAndSpectrumOrSaysWhatIsWrong) {
  const std::string head = "format = 1\nname = \"s\"\n[gearbox]\nkind = \"pair\"\nmodule_mm = 1\n[pinion]\nteeth = 20\nface_width_mm = 8\n[wheel]\nteeth = 40\nface_width_mm = 8\n[strength]\n";
  const GearboxDesign design = read(head + "input_speed_rpm = 1500\nlife_h = 200\nambient_c = 40\nlubrication = \"dry\"\nspectrum = \"1:0.2, 0.5 : 0.8\"\n");
  EXPECT_EQ(design.strength.input_speed_rpm, 1500.0);
  EXPECT_EQ(design.strength.life_h, 200.0);
  EXPECT_EQ(design.strength.ambient_c, 40.0);
  EXPECT_EQ(design.strength.lubrication, "dry");
  EXPECT_EQ(design.strength.spectrum, (std::vector<LoadStep>{{1.0, 0.2}, {0.5, 0.8}}));
  EXPECT_EQ(read(design_file_text(design)), design);
  for (const char* bad : {"", "1", "1:", "1:0.5", "1:0.5, ", "1:0.5,0:0.5", "-1:1", "1:0.5; 2:0.5", "nan:1", "x"}) {
    const auto refused = read_design_text(head + "spectrum = \"" + bad + "\"\n", "a.toml");
    ASSERT_FALSE(refused.has_value()) << bad;
    EXPECT_EQ(refused.error().front().key, "strength.spectrum") << bad;
    EXPECT_EQ(refused.error().front().line, 13) << bad;
  }
}

TEST(MadeTable, HoldsTolerancesAndAClearance) {
  const std::string head = "format = 1\nname = \"s\"\n[gearbox]\nkind = \"pair\"\nmodule_mm = 1\n[pinion]\nteeth = 20\nface_width_mm = 8\n[wheel]\nteeth = 40\nface_width_mm = 8\n[made]\n";
  const GearboxDesign design = read(head + "tolerance_class = 7\naxis_tolerance_um = 12.5\nthickness_tolerance_um = 8\nclearance_um = 15\n");
  EXPECT_EQ(design.made.tolerance_class, 7);
  EXPECT_NEAR(*design.made.axis_tolerance_mm, 0.0125, 1e-15);
  EXPECT_NEAR(*design.made.thickness_tolerance_mm, 0.008, 1e-15);
  EXPECT_NEAR(*design.made.clearance_mm, 0.015, 1e-15);
  const GearboxDesign again = read(design_file_text(design));
  EXPECT_NEAR(*again.made.clearance_mm, 0.015, 1e-12);
  EXPECT_EQ(again.made.tolerance_class, 7);
  for (const char* bad : {"tolerance_class = 0", "tolerance_class = 7.5", "clearance_um = -1"}) {
    const auto refused = read_design_text(head + bad + "\n", "a.toml");
    ASSERT_FALSE(refused.has_value()) << bad;
    EXPECT_EQ(refused.error().front().line, 13) << bad;
  }
}

}  // namespace
}  // namespace trueflank
