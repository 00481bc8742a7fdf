// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/workshop_drawings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/report.h"

namespace trueflank::io {
namespace {

/// An example laid out, with its report; lives as long as its sheets are looked at.
struct Drawn {
  explicit Drawn(const std::string& example) {
    const auto file = read_design_file(std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + example + "/design.toml");
    EXPECT_TRUE(file.has_value());
    train = std::make_shared<const GearTrain>(*lay_out(file->design));
    shapes = *part_shapes(*train);
    Report document;
    document.train = train;
    document.efficiency = efficiency(*train);
    report = nlohmann::ordered_json::parse(report_json(document));
  }
  [[nodiscard]] DrawingModel model() const { return {.train = train.get(), .shapes = &shapes, .report = &report, .materials = &materials}; }
  [[nodiscard]] const PartShape& part(const std::string& name) const {
    for (const PartShape& p : shapes.parts)
      if (p.name == name) return p;
    throw std::runtime_error("no part " + name);
  }
  std::shared_ptr<const GearTrain> train;
  PartShapes shapes;
  nlohmann::ordered_json report;
  StrengthOptions materials;
};

bool says(const Sheet& sheet, const std::string& words) {
  for (const SheetText& text : sheet.texts)
    if (text.text == words) return true;
  return false;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

double hatched_area(const AxialSection& section) {
  double area = 0.0;
  for (const SectionBand& band : section.bands)
    if (!band.teeth) area += (band.z_upper_mm - band.z_lower_mm) * (band.to_mm - band.from_mm);
  return area;
}

TEST(AxialSection, TheHatchedAreaIsThatOfBodyWithoutTeethAndHoles) {
  const Drawn drawn("bilateral_drive");
  const auto& gears = drawn.report["gears"];
  const double root = gears["sun"]["root_diameter_mm"], width = gears["sun"]["face_width_mm"];
  const BoreDesign& bore = find_gear(drawn.train->design, "sun")->bore;
  ASSERT_EQ(bore.kind, BoreKind::kDFlat);  // the plane of the section meets the flat
  EXPECT_NEAR(hatched_area(axial_section(drawn.part("sun"))), width * (root - bore.d_flat_mm), 1e-9);
}

TEST(AxialSection, EveryEdgeIsOnTheBoundaryOfMaterialOrAcrossAHole) {
  const Drawn drawn("bilateral_drive");
  for (const PartShape& part : drawn.shapes.parts)
    for (const SectionEdge& edge : axial_section(part).edges) {
      EXPECT_TRUE(edge.z1_mm == edge.z2_mm || edge.x1_mm == edge.x2_mm);
      EXPECT_LE(std::abs(edge.x1_mm), outermost_mm(part.slabs.front().outer) + 100.0);
    }
}

TEST(WorkshopDrawings, TheTableHoldsTheNumbersOfTheReport) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("planet"));
  for (const char* gear : {"planet1", "planet2"})
    for (const char* key : {"tip_diameter_mm", "root_diameter_mm", "base_diameter_mm"})
      EXPECT_TRUE(says(sheet, drawing_number(drawn.report["gears"][gear][key], 4))) << gear << ' ' << key;
  EXPECT_TRUE(says(sheet, "39"));
  EXPECT_TRUE(says(sheet, "ring2, z 81"));
}

TEST(WorkshopDrawings, EveryGearOfAPartAndItsUpperFaceHaveARunout) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("planet"));
  const PartDimensions asked = part_dimensions(*drawn.train, drawn.part("planet"));
  ASSERT_EQ(asked.tip_runouts.size(), 2U);
  ASSERT_TRUE(asked.face_runout);
  // a fifth of 16 um over 12 mm of teeth, on a face of 35.2551 mm: 9.4 um, which a face need not keep
  EXPECT_EQ(asked.face_runout->value_mm, 0.01);
  EXPECT_TRUE(says(sheet, drawing_number(asked.face_runout->value_mm, 3)));
  EXPECT_TRUE(says(sheet, drawing_number(asked.tip_runouts[0].value_mm, 3)));
  EXPECT_EQ(std::count_if(sheet.texts.begin(), sheet.texts.end(), [](const SheetText& t) { return t.text == "A" && t.height_mm < 3.2; }), 4);
}

TEST(WorkshopDrawings, AGearWithoutABoreHasNoDatumAndNoRunout) {
  const Drawn drawn("pinion_8_undercut");
  for (const PartShape& part : drawn.shapes.parts) {
    PartShape solid = part;
    for (Slab& slab : solid.slabs) slab.holes.clear();
    const PartDimensions asked = part_dimensions(*drawn.train, solid);
    EXPECT_EQ(asked.datum(), nullptr);
    EXPECT_TRUE(asked.tip_runouts.empty());
    EXPECT_FALSE(asked.face_runout);
  }
}

TEST(WorkshopDrawings, SizesWithoutAFitHaveTheGeneralTolerance) {
  // ISO 2768-1, class m
  for (const auto& [size, limit] : {std::pair{0.5, 0.1}, {6.0, 0.1}, {6.1, 0.2}, {30.0, 0.2}, {31.0, 0.3}, {120.0, 0.3}, {400.0, 0.5}, {1000.0, 0.8}}) {
    EXPECT_EQ(general_limits(size).upper_mm, limit) << size;
    EXPECT_EQ(general_limits(size).lower_mm, -limit) << size;
  }
  EXPECT_TRUE(std::isnan(general_limits(0.4).upper_mm));
  EXPECT_TRUE(std::isnan(general_limits(5000.0).upper_mm));
}

TEST(WorkshopDrawings, TheAssemblyListsEveryPartWithItsCount) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = assembly_sheet(drawn.model());
  EXPECT_TRUE(says(sheet, "Planet, z 39, z 32"));
  EXPECT_TRUE(says(sheet, "3"));
  EXPECT_TRUE(says(sheet, "Ring 2, z 81"));
}

TEST(WorkshopDrawings, EverythingLiesOnTheSheetForEveryExample) {
  for (const char* example : {"bilateral_drive", "external_pair", "internal_pair", "helical_planetary", "carried_drive",
                              "simple_planetary", "pinion_8_undercut", "ring_shaper", "relieved_3k", "herringbone_pair"}) {
    const Drawn drawn(example);
    for (const PartShape& part : drawn.shapes.parts) {
      const Sheet sheet = part_sheet(drawn.model(), part);
      for (const SheetPath& path : sheet.paths)
        for (const Point2& p : path.points) {
          EXPECT_GE(p.minCoeff(), 9.9) << example << ' ' << part.name;
          EXPECT_LE(p.x(), sheet.width_mm - 9.9) << example << ' ' << part.name;
          EXPECT_LE(p.y(), sheet.height_mm - 9.9) << example << ' ' << part.name;
        }
    }
  }
}

TEST(WorkshopDrawings, TheSameDesignGivesTheSameBytes) {
  const Drawn drawn("external_pair");
  const std::filesystem::path folder = std::filesystem::path(TRUEFLANK_TEST_OUTPUT_DIR) / "drawings";
  for (const char* run : {"1", "2"}) {
    std::filesystem::create_directories(folder / run);
    const auto files = write_workshop_drawings(drawn.model(), {.folder = folder / run, .part = ""});
    ASSERT_TRUE(files.has_value());
    EXPECT_EQ(files->size(), 6U);  // pinion, wheel, assembly
  }
  for (const char* name : {"pinion.pdf", "pinion_drawing.dxf", "assembly.pdf"})
    EXPECT_EQ(bytes_of(folder / "1" / name), bytes_of(folder / "2" / name)) << name;
}

TEST(WorkshopDrawings, AFolderThatIsNotThereIsSaid) {
  const Drawn drawn("external_pair");
  const auto files = write_workshop_drawings(drawn.model(), {.folder = "/nonexistent/folder", .part = ""});
  ASSERT_FALSE(files.has_value());
  EXPECT_EQ(files.error().code, ErrorCode::kFileNotFound);
}

}  // namespace
}  // namespace trueflank::io
