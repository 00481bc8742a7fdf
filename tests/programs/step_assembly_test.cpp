// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCASCADE's document framework reads the assembly: what a CAD system shows in its tree.
#include <gtest/gtest.h>

#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDF_Tool.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <sstream>

#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/export/step/step_writer.h"

namespace trueflank {
namespace {

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  std::string utf8(static_cast<std::size_t>(name->Get().LengthOfCString()) + 1, '\0');
  Standard_PCharacter buffer = utf8.data();
  utf8.resize(static_cast<std::size_t>(name->Get().ToUTF8CString(buffer)));
  return utf8;
}

/// A document made from STEP text.
class StepDocument {
 public:
  explicit StepDocument(const std::string& text) {
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    STEPCAFControl_Reader reader;
    reader.SetNameMode(true);
    reader.SetColorMode(true);
    std::istringstream stream(text);
    EXPECT_EQ(reader.ChangeReader().ReadStream("assembly", stream), IFSelect_RetDone);
    EXPECT_TRUE(reader.Transfer(document_));
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    colours_ = XCAFDoc_DocumentTool::ColorTool(document_->Main());
  }
  ~StepDocument() { XCAFApp_Application::GetApplication()->Close(document_); }
  StepDocument(const StepDocument&) = delete;
  StepDocument& operator=(const StepDocument&) = delete;

  XCAFDoc_ShapeTool& shapes() { return *shapes_; }
  XCAFDoc_ColorTool& colours() { return *colours_; }

  TDF_Label only_free_shape() {
    TDF_LabelSequence free;
    shapes_->GetFreeShapes(free);
    EXPECT_EQ(free.Length(), 1);
    return free.Length() > 0 ? free.Value(1) : TDF_Label();
  }
  TDF_LabelSequence components(const TDF_Label& assembly) {
    TDF_LabelSequence found;
    XCAFDoc_ShapeTool::GetComponents(assembly, found);
    return found;
  }

 private:
  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colours_;
};

io::StepPart part_of(const PartShape& shape, std::array<double, 3> colour) {
  auto solid = brep_of(shape);
  EXPECT_TRUE(solid);
  return {.name = shape.name, .solid = std::move(*solid), .colour = colour};
}

class StepAssembly : public ::testing::Test {
 protected:
  StepAssembly() {
    const auto sun = ToothProfile::make(test::external_gear(12, 0.3));
    const auto planet1 = ToothProfile::make(test::external_gear(39, 0.3));
    const auto planet2 = ToothProfile::make(test::external_gear(32, 0.4));
    parts_ = {part_of(test::gear_part("sun", *sun, 10.0), {1.0, 0.5, 0.1}),
              part_of(test::planet_part(*planet1, *planet2), {0.2, 0.5, 0.9})};
    for (int i = 0; i < 3; ++i) {
      const Point2 at = 25.6826 * unit_vector(kTwoPi * i / 3.0);
      placements_.push_back({.part = 1, .name = "planet " + std::to_string(i + 1),
                             .rotation_rad = 0.3 + i, .translation_mm = {at.x(), at.y(), 0.5}});
    }
    placements_.push_back({.part = 0, .name = "sun", .rotation_rad = 0.1});
  }

  /// The assembly, read once for all tests that look at it.
  StepDocument& gearbox() {
    static StepDocument document(io::step_text(parts_, placements_, "gearbox"));
    return document;
  }

  std::vector<io::StepPart> parts_;
  std::vector<Placement> placements_;
};

TEST_F(StepAssembly, BodiesHaveTheirNamesAndPlaces) {
  StepDocument& document = gearbox();
  const TDF_Label assembly = document.only_free_shape();
  ASSERT_TRUE(XCAFDoc_ShapeTool::IsAssembly(assembly));
  EXPECT_EQ(name_of(assembly), "gearbox");
  const TDF_LabelSequence bodies = document.components(assembly);
  ASSERT_EQ(bodies.Length(), 4);
  for (int i = 0; i < 4; ++i) {
    const Placement& placement = placements_[static_cast<std::size_t>(i)];
    const TDF_Label body = bodies.Value(i + 1);
    EXPECT_EQ(name_of(body), placement.name);
    const gp_Trsf move = XCAFDoc_ShapeTool::GetLocation(body).Transformation();
    const gp_Pnt moved = gp_Pnt(2.0, 1.0, 3.0).Transformed(move);
    const Point2 turned = rotated({2.0, 1.0}, placement.rotation_rad);
    EXPECT_NEAR(moved.X(), turned.x() + placement.translation_mm[0], 1e-9);
    EXPECT_NEAR(moved.Y(), turned.y() + placement.translation_mm[1], 1e-9);
    EXPECT_NEAR(moved.Z(), 3.0 + placement.translation_mm[2], 1e-9);
  }
}

TEST_F(StepAssembly, BodiesShareTheirParts) {
  StepDocument& document = gearbox();
  const TDF_LabelSequence bodies = document.components(document.only_free_shape());
  ASSERT_EQ(bodies.Length(), 4);
  std::vector<TDF_Label> referred(4);
  for (int i = 0; i < 4; ++i)
    ASSERT_TRUE(XCAFDoc_ShapeTool::GetReferredShape(bodies.Value(i + 1), referred[i]));
  EXPECT_EQ(referred[0], referred[1]);
  EXPECT_EQ(referred[0], referred[2]);
  EXPECT_FALSE(referred[0] == referred[3]);
  EXPECT_EQ(name_of(referred[0]), "planet");
  EXPECT_EQ(name_of(referred[3]), "sun");
  for (const TDF_Label& part : {referred[0], referred[3]}) {
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(XCAFDoc_ShapeTool::GetShape(part), TopAbs_SOLID, solids);
    EXPECT_EQ(solids.Extent(), 1);
  }
}

TEST_F(StepAssembly, PartsHaveTheirColours) {
  StepDocument& document = gearbox();
  const TDF_LabelSequence bodies = document.components(document.only_free_shape());
  ASSERT_EQ(bodies.Length(), 4);
  for (const int i : {0, 3}) {
    TDF_Label part;
    ASSERT_TRUE(XCAFDoc_ShapeTool::GetReferredShape(bodies.Value(i + 1), part));
    Quantity_Color colour;
    ASSERT_TRUE(document.colours().GetColor(XCAFDoc_ShapeTool::GetShape(part), XCAFDoc_ColorSurf, colour));
    double red = 0, green = 0, blue = 0;
    colour.Values(red, green, blue, Quantity_TOC_sRGB);
    const auto& expected = parts_[static_cast<std::size_t>(placements_[static_cast<std::size_t>(i)].part)].colour;
    EXPECT_NEAR(red, expected[0], 1e-6);
    EXPECT_NEAR(green, expected[1], 1e-6);
    EXPECT_NEAR(blue, expected[2], 1e-6);
  }
}

TEST_F(StepAssembly, NamesBeyondAsciiSurvive) {
  parts_[0].name = "Sönne 'a' \\ 太陽";
  StepDocument document(io::step_text(parts_[0]));
  EXPECT_EQ(name_of(document.only_free_shape()), parts_[0].name);
}

}  // namespace
}  // namespace trueflank
