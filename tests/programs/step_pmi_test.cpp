// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCASCADE's document framework reads the product information of AP242 files: sizes, limits,
// datums and tolerances, and the faces they hang on.
#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDimTolObjects_DatumObject.hxx>
#include <XCAFDimTolObjects_DimensionObject.hxx>
#include <XCAFDimTolObjects_GeomToleranceObject.hxx>
#include <XCAFDoc_Datum.hxx>
#include <XCAFDoc_DimTolTool.hxx>
#include <XCAFDoc_Dimension.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GeomTolerance.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/programs/opencascade_solid.h"
#include "tests/support/random_designs.h"
#include "tests/support/survey_size.h"
#include "trueflank/design/design_file.h"
#include "trueflank/geometry/flank_tolerance.h"

namespace trueflank {
namespace {

using Faces = std::vector<TopoDS_Face>;

struct ReadDimension {
  XCAFDimTolObjects_DimensionType type;
  double value = 0.0, lower = 0.0, upper = 0.0;
  bool limited = false;
  std::string note;
  Faces first, second;
};
struct ReadTolerance {
  XCAFDimTolObjects_GeomToleranceType type;
  XCAFDimTolObjects_GeomToleranceTypeValue zone;
  double value = 0.0;
  Faces faces;
  std::vector<std::string> datums;
  Faces datum_faces;
};
struct ReadPmi {
  std::vector<ReadDimension> dimensions;
  std::vector<ReadTolerance> tolerances;
  int solids = 0;
};

Faces faces_of(const TDF_LabelSequence& labels) {
  Faces faces;
  for (int i = 1; i <= labels.Length(); ++i)
    faces.push_back(TopoDS::Face(XCAFDoc_ShapeTool::GetShape(labels.Value(i))));
  return faces;
}

ReadDimension read_dimension(const XCAFDoc_DimTolTool& tool, const TDF_Label& label) {
  Handle(XCAFDoc_Dimension) attribute;
  EXPECT_TRUE(label.FindAttribute(XCAFDoc_Dimension::GetID(), attribute));
  const Handle(XCAFDimTolObjects_DimensionObject) object = attribute->GetObject();
  ReadDimension read{.type = object->GetType(),
                     .value = object->GetValue(),
                     .note = {},
                     .first = {},
                     .second = {}};
  read.limited = object->IsDimWithPlusMinusTolerance();
  if (read.limited) {
    read.lower = object->GetLowerTolValue();
    read.upper = object->GetUpperTolValue();
  }
  if (object->NbDescriptions() > 0) read.note = object->GetDescription(0)->ToCString();
  TDF_LabelSequence first, second;
  tool.GetRefShapeLabel(label, first, second);
  read.first = faces_of(first);
  read.second = faces_of(second);
  return read;
}

ReadTolerance read_tolerance(const XCAFDoc_DimTolTool& tool, const TDF_Label& label) {
  Handle(XCAFDoc_GeomTolerance) attribute;
  EXPECT_TRUE(label.FindAttribute(XCAFDoc_GeomTolerance::GetID(), attribute));
  ReadTolerance read{.type = attribute->GetObject()->GetType(),
                     .zone = attribute->GetObject()->GetTypeOfValue(),
                     .value = attribute->GetObject()->GetValue(),
                     .faces = {},
                     .datums = {},
                     .datum_faces = {}};
  TDF_LabelSequence first, second, datums;
  tool.GetRefShapeLabel(label, first, second);
  read.faces = faces_of(first);
  tool.GetDatumWithObjectOfTolerLabels(label, datums);
  for (int i = 1; i <= datums.Length(); ++i) {
    Handle(XCAFDoc_Datum) datum;
    EXPECT_TRUE(datums.Value(i).FindAttribute(XCAFDoc_Datum::GetID(), datum));
    read.datums.emplace_back(datum->GetObject()->GetName()->ToCString());
    TDF_LabelSequence on, none;
    tool.GetRefShapeLabel(datums.Value(i), on, none);
    for (const TopoDS_Face& face : faces_of(on)) read.datum_faces.push_back(face);
  }
  return read;
}

ReadPmi read_pmi(const std::string& text) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader;
  reader.SetGDTMode(true);
  std::istringstream stream(text);
  EXPECT_EQ(reader.ChangeReader().ReadStream("part", stream), IFSelect_RetDone);
  EXPECT_TRUE(reader.Transfer(document));
  const Handle(XCAFDoc_DimTolTool) tool = XCAFDoc_DocumentTool::DimTolTool(document->Main());
  TDF_LabelSequence dimensions, tolerances;
  tool->GetDimensionLabels(dimensions);
  tool->GetGeomToleranceLabels(tolerances);
  ReadPmi read;
  for (int i = 1; i <= dimensions.Length(); ++i)
    read.dimensions.push_back(read_dimension(*tool, dimensions.Value(i)));
  for (int i = 1; i <= tolerances.Length(); ++i)
    read.tolerances.push_back(read_tolerance(*tool, tolerances.Value(i)));
  TDF_LabelSequence free;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(free);
  for (int i = 1; i <= free.Length(); ++i)
    read.solids += test::count(XCAFDoc_ShapeTool::GetShape(free.Value(i)), TopAbs_SOLID);
  XCAFApp_Application::GetApplication()->Close(document);
  return read;
}

void expect_cylinders(const Faces& faces, double diameter_mm) {
  EXPECT_FALSE(faces.empty());
  for (const TopoDS_Face& face : faces) {
    const BRepAdaptor_Surface surface(face);
    ASSERT_EQ(surface.GetType(), GeomAbs_Cylinder);
    EXPECT_NEAR(2.0 * surface.Cylinder().Radius(), diameter_mm, 1e-9);
  }
}
double height_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  EXPECT_EQ(surface.GetType(), GeomAbs_Plane);
  return surface.Plane().Location().Z();
}

void expect_dimension(const ReadDimension& read, double value_mm, const io::SizeLimits& limits) {
  EXPECT_NEAR(read.value, value_mm, 1e-12 * value_mm);
  EXPECT_EQ(read.limited, !std::isnan(limits.upper_mm));
  if (!read.limited) return;
  EXPECT_NEAR(read.lower, std::abs(limits.lower_mm), 1e-15);  // OpenCASCADE tells its size
  EXPECT_NEAR(read.upper, limits.upper_mm, 1e-15);
}

XCAFDimTolObjects_GeomToleranceType type_of(io::ToleranceKind kind) {
  switch (kind) {
    case io::ToleranceKind::kCircularRunout:
      return XCAFDimTolObjects_GeomToleranceType_CircularRunout;
    case io::ToleranceKind::kTotalRunout:
      return XCAFDimTolObjects_GeomToleranceType_TotalRunout;
    case io::ToleranceKind::kFlatness:
      return XCAFDimTolObjects_GeomToleranceType_Flatness;
    case io::ToleranceKind::kParallelism:
      return XCAFDimTolObjects_GeomToleranceType_Parallelism;
    case io::ToleranceKind::kCylindricity:
      return XCAFDimTolObjects_GeomToleranceType_Cylindricity;
    case io::ToleranceKind::kPosition:
      return XCAFDimTolObjects_GeomToleranceType_Position;
  }
  return XCAFDimTolObjects_GeomToleranceType_None;
}

/// What is asked of the part stands in the file, on faces that have the sizes it says.
void expect_same(const ReadPmi& read, const io::StepPmi& pmi) {
  ASSERT_EQ(read.dimensions.size(), pmi.dimensions.size());
  for (std::size_t i = 0; i < pmi.dimensions.size(); ++i) {
    const ReadDimension& d = read.dimensions[i];
    const io::PmiDimension& asked = pmi.dimensions[i];
    SCOPED_TRACE("dimension " + std::to_string(asked.value_mm));
    expect_dimension(d, asked.value_mm, asked.limits);
    EXPECT_EQ(d.note, asked.note);
    EXPECT_EQ(d.first.size(), asked.faces.size());
    EXPECT_EQ(d.second.size(), asked.other_faces.size());
    if (asked.other_faces.empty()) {
      EXPECT_EQ(d.type, XCAFDimTolObjects_DimensionType_Size_Diameter);
      expect_cylinders(d.first, asked.value_mm);
    } else {
      EXPECT_EQ(d.type, XCAFDimTolObjects_DimensionType_Location_LinearDistance);
    }
  }
  ASSERT_EQ(read.tolerances.size(), pmi.tolerances.size());
  for (std::size_t i = 0; i < pmi.tolerances.size(); ++i) {
    const io::PmiTolerance& asked = pmi.tolerances[i];
    EXPECT_EQ(read.tolerances[i].type, type_of(asked.kind));
    EXPECT_EQ(read.tolerances[i].zone, asked.kind == io::ToleranceKind::kPosition
                                           ? XCAFDimTolObjects_GeomToleranceTypeValue_Diameter
                                           : XCAFDimTolObjects_GeomToleranceTypeValue_None);
    EXPECT_NEAR(read.tolerances[i].value, asked.value_mm, 1e-15);
    EXPECT_EQ(read.tolerances[i].faces.size(), asked.faces.size());
    const std::vector<std::string> datums =
        asked.datum == 0 ? std::vector<std::string>{} : std::vector{std::string(1, asked.datum)};
    EXPECT_EQ(read.tolerances[i].datums, datums) << asked.name;
    EXPECT_EQ(read.tolerances[i].datum_faces.size(), asked.datum == 'A'   ? pmi.datum.size()
                                                     : asked.datum == 'B' ? pmi.datum_b.size()
                                                                          : 0U);
  }
}

std::string ap242(const PartShape& part, Brep solid, const io::StepPmi& pmi) {
  return io::step_text({.name = part.name, .solid = std::move(solid), .pmi = pmi},
                       io::StepSchema::kAp242);
}

/// An example laid out, and its parts.
struct Example {
  explicit Example(const std::string& name) {
    const auto file =
        read_design_file(std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + name + "/design.toml");
    EXPECT_TRUE(file.has_value());
    train = std::make_shared<const GearTrain>(*lay_out(file->design));
    shapes = *part_shapes(*train);
  }
  /// Read once for all tests that look at the part.
  [[nodiscard]] const ReadPmi& read(const std::string& name) const {
    const auto [kept, is_new] = read_.try_emplace(name);
    if (is_new) kept->second = read_anew(name);
    return kept->second;
  }
  [[nodiscard]] const TrainGear& gear(const std::string& name) const {
    return *std::find_if(train->gears.begin(), train->gears.end(),
                         [&](const TrainGear& g) { return g.name == name; });
  }
  [[nodiscard]] FlankTolerances limits(const std::string& name) const {
    const TrainGear& g = gear(name);
    return *flank_tolerances(tolerance_size(g.profile.gear(), g.face_width_mm),
                             io::kDrawingToleranceClass);
  }
  std::shared_ptr<const GearTrain> train;
  PartShapes shapes;

 private:
  [[nodiscard]] ReadPmi read_anew(const std::string& name) const {
    for (const PartShape& part : shapes.parts) {
      if (part.name != name) continue;
      auto solid = brep_of(part);
      EXPECT_TRUE(solid);
      const io::StepPmi pmi = io::step_pmi(*train, part, *solid);
      return read_pmi(ap242(part, std::move(*solid), pmi));
    }
    ADD_FAILURE() << "no part " << name;
    return {};
  }
  mutable std::map<std::string, ReadPmi> read_;
};

const Example& bilateral_drive() {
  static const Example example("bilateral_drive");
  return example;
}

const ReadDimension* diameter(const ReadPmi& pmi, double value_mm) {
  for (const ReadDimension& d : pmi.dimensions)
    if (d.second.empty() && std::abs(d.value - value_mm) < 1e-9) return &d;
  return nullptr;
}

TEST(StepPmi, ABoreHasItsFitAndCarriesTheDatum) {
  const Example& example = bilateral_drive();
  const ReadPmi& pmi = example.read("planet");
  const double bore_mm = find_gear(example.train->design, "planet1")->bore.diameter_mm;
  const ReadDimension* bore = diameter(pmi, bore_mm);
  ASSERT_NE(bore, nullptr);
  EXPECT_EQ(bore->note, "H7");
  ASSERT_EQ(bore_mm, 19.0);
  expect_dimension(*bore, bore_mm, {.lower_mm = 0.0, .upper_mm = 0.021});  // ISO 286-1, 18 to 30 mm
  expect_cylinders(bore->first, bore_mm);
  // the tips of two gears, the upper face (runout, flatness), the lower face, the bore
  ASSERT_EQ(pmi.tolerances.size(), 6U);
  for (const ReadTolerance& tolerance : pmi.tolerances)
    if (tolerance.datums == std::vector<std::string>{"A"})
      expect_cylinders(tolerance.datum_faces, bore_mm);
}

TEST(StepPmi, TipsRunAsTrueAsTheTeethHaveTo) {
  const Example& example = bilateral_drive();
  const ReadPmi& pmi = example.read("planet");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "planet1" : "planet2";
    const TrainGear& gear = example.gear(name);
    EXPECT_NEAR(pmi.tolerances[i].value, example.limits(name).runout_um / 1000.0, 1e-15);
    EXPECT_EQ(static_cast<int>(pmi.tolerances[i].faces.size()), gear.profile.gear().teeth);
    expect_cylinders(pmi.tolerances[i].faces, 2.0 * gear.profile.tip_radius_mm());
  }
}

TEST(StepPmi, WidthsAreBetweenTheFacesTheySpan) {
  const Example& example = bilateral_drive();
  const ReadPmi& pmi = example.read("planet");
  const double whole_mm = example.gear("planet1").face_width_mm +
                          example.gear("planet2").face_width_mm +
                          example.train->design.layer_gap_mm;
  const ReadDimension& whole = pmi.dimensions.back();
  EXPECT_EQ(whole.type, XCAFDimTolObjects_DimensionType_Location_LinearDistance);
  expect_dimension(whole, whole_mm,
                   {.lower_mm = -0.2, .upper_mm = 0.2});  // ISO 2768-1 m, 6 to 30 mm
  ASSERT_EQ(whole.first.size(), 1U);
  ASSERT_EQ(whole.second.size(), 1U);
  EXPECT_NEAR(height_of(whole.first[0]), 0.0, 1e-12);
  EXPECT_NEAR(height_of(whole.second[0]), whole_mm, 1e-12);
}

TEST(StepPmi, ARingIsHeldByItsOuterCylinder) {
  const Example& example = bilateral_drive();
  const ReadPmi& pmi = example.read("ring1");
  ASSERT_EQ(pmi.tolerances.size(), 5U);  // tips, upper face twice, lower face, bolts
  const double outer_mm = *find_gear(example.train->design, "ring1")->outer_diameter_mm;
  for (std::size_t i : {0, 1}) expect_cylinders(pmi.tolerances[i].datum_faces, outer_mm);
  expect_cylinders(pmi.tolerances[0].faces, 2.0 * example.gear("ring1").profile.tip_radius_mm());
  ASSERT_EQ(pmi.tolerances[1].faces.size(), 1U);
  EXPECT_NEAR(height_of(pmi.tolerances[1].faces[0]), example.gear("ring1").face_width_mm, 1e-12);
}

TEST(StepPmi, FacesAreFlatAndParallelAndHolesStandInTheirZones) {
  const Example example("carried_drive");
  const ReadPmi &planet = example.read("planet"), &plate = example.read("carrier");
  const auto of_type = [](const ReadPmi& pmi, XCAFDimTolObjects_GeomToleranceType type) {
    const auto found = std::find_if(pmi.tolerances.begin(), pmi.tolerances.end(),
                                    [&](const ReadTolerance& t) { return t.type == type; });
    return found == pmi.tolerances.end() ? nullptr : &*found;
  };
  const ReadTolerance* parallel = of_type(planet, XCAFDimTolObjects_GeomToleranceType_Parallelism);
  ASSERT_NE(parallel, nullptr);
  EXPECT_EQ(parallel->datums, std::vector<std::string>{"B"});
  ASSERT_EQ(parallel->datum_faces.size(), 1U);
  EXPECT_NEAR(height_of(parallel->faces.at(0)), 0.0, 1e-12);
  EXPECT_NEAR(height_of(parallel->datum_faces[0]), 27.0, 1e-12);
  const ReadTolerance* position = of_type(plate, XCAFDimTolObjects_GeomToleranceType_Position);
  ASSERT_NE(position, nullptr);
  EXPECT_EQ(position->zone, XCAFDimTolObjects_GeomToleranceTypeValue_Diameter);
  EXPECT_NEAR(position->value, 0.021, 1e-15);
  EXPECT_EQ(position->faces.size(), 3U);
  expect_cylinders(position->faces, 10.02);
  expect_cylinders(position->datum_faces, 32.0);
}

TEST(StepPmi, AnAssemblyHasTheInformationOfEveryPart) {
  const Example example("simple_planetary");
  std::vector<io::StepPart> parts;
  std::size_t dimensions = 0, runouts = 0;
  for (const PartShape& shape : example.shapes.parts) {
    auto solid = brep_of(shape);
    ASSERT_TRUE(solid);
    io::StepPmi pmi = io::step_pmi(*example.train, shape, *solid);
    dimensions += pmi.dimensions.size();
    runouts += pmi.tolerances.size();
    parts.push_back({.name = shape.name, .solid = std::move(*solid), .pmi = std::move(pmi)});
  }
  const ReadPmi read =
      read_pmi(io::step_text(parts, example.shapes.assembly, "set", io::StepSchema::kAp242));
  EXPECT_EQ(read.dimensions.size(), dimensions);
  EXPECT_EQ(read.tolerances.size(), runouts);
  EXPECT_GE(runouts, 5U);
}

TEST(StepPmi, Ap214FilesHaveNone) {
  const Example example("external_pair");
  const PartShape& part = example.shapes.parts.front();
  auto solid = brep_of(part);
  ASSERT_TRUE(solid);
  const io::StepPmi pmi = io::step_pmi(*example.train, part, *solid);
  ASSERT_FALSE(pmi.dimensions.empty());
  const std::string plain = io::step_text({.name = part.name, .solid = *solid});
  EXPECT_EQ(io::step_text({.name = part.name, .solid = *solid, .pmi = pmi}), plain);
  EXPECT_TRUE(read_pmi(plain).dimensions.empty());
}

/// External gears, rings, twisted, modified, with bores of every kind.
TEST(StepPmi, RandomPartsReadBackAsAsked) {
  test::RandomDesigns designs(17);
  int parts = 0, rings = 0, twisted = 0, runouts = 0;
  for (int i = 0; i < 80 && parts < test::survey_size(7, 14); ++i) {
    const auto train = lay_out(designs.next());
    if (!train) continue;
    const auto shapes = part_shapes(*train);
    if (!shapes) continue;
    for (const PartShape& part : shapes->parts) {
      const auto gears = io::gears_of(*train, part);
      if (gears.empty() || gears.front()->profile.gear().teeth > 36) continue;
      auto solid = brep_of(part);
      if (!solid) continue;
      const io::StepPmi pmi = io::step_pmi(*train, part, *solid);
      SCOPED_TRACE("design " + std::to_string(i) + " " + part.name);
      EXPECT_FALSE(pmi.dimensions.empty());
      const std::string text = ap242(part, std::move(*solid), pmi);
      const ReadPmi read = read_pmi(text);
      EXPECT_EQ(read.solids, 1);
      expect_same(read, pmi);
      ++parts;
      rings += gears.front()->profile.gear().kind == GearKind::kInternal;
      twisted += gears.front()->profile.gear().helix_angle_rad != 0.0;
      runouts += static_cast<int>(pmi.tolerances.size());
    }
  }
  std::cout << parts << " parts, " << rings << " rings, " << twisted << " twisted, " << runouts
            << " runouts\n";
  const int of_all = test::survey_size(2, 1);
  EXPECT_GE(of_all * parts, 12);
  EXPECT_GE(rings, 1);
  EXPECT_GE(of_all * twisted, 4);
  EXPECT_GE(of_all * runouts, 8);
}

}  // namespace
}  // namespace trueflank
