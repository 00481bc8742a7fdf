// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_Shell.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <map>
#include <sstream>
#include <string>

#include "tests/support/sample_parts.h"
#include "trueflank/export/step/step_writer.h"

// OpenCASCADE reads our STEP text and judges the solid it finds.
namespace trueflank::test {

/// Quiet while it reads.
class SilentOpenCascade : public ::testing::Environment {
 public:
  void SetUp() override { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }
};
inline const auto* const kSilence = ::testing::AddGlobalTestEnvironment(new SilentOpenCascade);

inline TopoDS_Shape read_back(const PartShape& part) {
  auto solid = brep_of(part);
  EXPECT_TRUE(solid) << part.name << ": " << solid.error().message;
  if (!solid) return {};
  EXPECT_TRUE(is_closed(*solid)) << part.name;
  std::istringstream text(io::step_text({.name = part.name, .solid = std::move(*solid)}));
  STEPControl_Reader reader;
  EXPECT_EQ(reader.ReadStream(part.name.c_str(), text), IFSelect_RetDone) << part.name;
  reader.TransferRoots();
  return reader.OneShape();
}

inline int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map.Extent();
}

inline std::map<GeomAbs_SurfaceType, int> surface_types(const TopoDS_Shape& shape) {
  std::map<GeomAbs_SurfaceType, int> types;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
    ++types[BRepAdaptor_Surface(TopoDS::Face(it.Current())).GetType()];
  return types;
}

/// One closed valid solid, oriented outwards, of a volume.
inline void expect_solid(const PartShape& part, const TopoDS_Shape& shape, double volume_mm3) {
  ASSERT_FALSE(shape.IsNull()) << part.name;
  EXPECT_EQ(shape.ShapeType(), TopAbs_SOLID) << part.name;
  EXPECT_EQ(count(shape, TopAbs_SOLID), 1) << part.name;
  EXPECT_EQ(count(shape, TopAbs_SHELL), 1) << part.name;
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid()) << part.name;
  ShapeAnalysis_Shell shell;
  shell.LoadShells(shape);
  EXPECT_FALSE(shell.CheckOrientedShells(shape, true, true)) << part.name << ": bad or free edges";
  EXPECT_FALSE(shell.HasFreeEdges()) << part.name;
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  EXPECT_NEAR(properties.Mass(), volume_mm3, 1e-6 * volume_mm3) << part.name;
}

/// The same, of the volume that the exact curves give: a section's area times the width, whether the
/// section turns or not (Cavalieri).
inline void expect_exact_solid(const PartShape& part, const TopoDS_Shape& shape) {
  expect_solid(part, shape, exact_volume_mm3(part));
}

}  // namespace trueflank::test
