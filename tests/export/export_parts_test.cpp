// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/mesh_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/export/sample_scene.h"
#include "trueflank/design/design_file.h"

namespace trueflank::io {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

/// A design of examples/, laid out and meshed.
struct Example {
  GearTrain train;
  PartShapes shapes;
  std::vector<PartMesh> meshes;
  explicit Example(const std::string& name) {
    const std::string path = std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + name + "/design.toml";
    train = lay_out(read_design(path).value()).value();
    shapes = part_shapes(train).value();
    for (const PartShape& shape : shapes.parts) meshes.push_back(part_mesh(shape));
  }
  [[nodiscard]] ExportModel model() const { return {&train, &shapes, &meshes}; }
};

const Example& drive() {
  static const Example example("bilateral_drive");
  return example;
}

TEST(ExportParts, WritesOneFileAPartAndFormatAndTheAssembly) {
  const ScratchFolder folder;
  const auto files =
      export_parts(drive().model(), {.folder = folder / "new" / "folder", .formats = file_formats()});
  ASSERT_TRUE(files) << files.error().front().message;
  std::set<std::string> reported, found;
  for (const ReportedFile& file : *files) {
    reported.insert(file.path);
    EXPECT_EQ(file.bytes, fs::file_size(folder / "new" / "folder" / file.path)) << file.path;
    EXPECT_GT(file.bytes, 500U) << file.path;
  }
  for (const auto& entry : fs::directory_iterator(folder / "new" / "folder"))
    found.insert(entry.path().filename());
  std::set<std::string> expected;
  for (const char* part : {"sun", "planet", "ring1", "ring2", "assembly"})
    for (const FileFormat format : file_formats())
      if (!is_paper(format)) expected.insert(std::string(part) + "." + to_text(format));
  EXPECT_EQ(reported, expected);
  EXPECT_EQ(found, expected);
}

TEST(ExportParts, KeepsTheToleranceInEveryFileRoundingIncluded) {
  const ScratchFolder folder;
  for (const double tolerance_mm : {2e-4, 1e-3, 2e-2}) {
    const auto files = export_parts({.train = &drive().train, .shapes = &drive().shapes},
                                    {.folder = folder.path(),
                                     .formats = {FileFormat::kStl, FileFormat::kGlb, FileFormat::kObj},
                                     .tolerance_mm = tolerance_mm});
    ASSERT_TRUE(files) << files.error().front().message;
    for (const ReportedFile& file : *files) {
      EXPECT_LE(file.accuracy_um, um_from_mm(tolerance_mm)) << file.path;
      EXPECT_GT(file.accuracy_um, 0.7 * um_from_mm(tolerance_mm)) << file.path;
    }
  }
}

/// All files of a design keep the tolerance.
void expect_kept(const std::string& text, std::vector<FileFormat> formats, double tolerance_um) {
  const auto design = read_design_text(text, "design.toml");
  ASSERT_TRUE(design);
  const GearTrain train = lay_out(*design).value();
  const PartShapes shapes = part_shapes(train).value();
  const ScratchFolder folder;
  const auto files = export_parts({.train = &train, .shapes = &shapes},
                                  {.folder = folder.path(),
                                   .formats = std::move(formats),
                                   .tolerance_mm = mm_from_um(tolerance_um)});
  ASSERT_TRUE(files) << files.error().front().message;
  for (const ReportedFile& file : *files) EXPECT_LE(file.accuracy_um, tolerance_um) << file.path;
}

TEST(ExportParts, KeepsTheToleranceOfAFileThatIsToldByAnotherOne) {
  // One file of a part is measured and tells the others: both roundings count, of one size here.
  expect_kept(R"(format = 1
name = "small"
[gearbox]
kind = "gear"
module_mm = 0.3
helix_angle_deg = -17.36
[rack]
pressure_angle_deg = 17.5
addendum = 0.878
[gear]
internal = true
teeth = 26
shift = 0.4726
face_width_mm = 3.479
[gear.modifications]
end_relief_um = 1.54
end_relief_length_mm = 0.519
)", {FileFormat::kStl, FileFormat::k3mf, FileFormat::kObj}, 0.15);
}

TEST(ExportParts, KeepsTheAssemblyOfAWheelWhoseFarSideIsRoundedInItsOwnFrame) {
  // Beside the pinion the wheel's coordinates are small in the assembly, and 900 mm in its own frame,
  // in which glTF holds them as floats.
  expect_kept(R"(format = 1
name = "far"
[gearbox]
kind = "pair"
module_mm = 6
[pinion]
teeth = 13
shift = 0.2
face_width_mm = 5
[wheel]
teeth = 305
shift = 0
face_width_mm = 5
)", {FileFormat::kStl, FileFormat::kGlb}, 20.0);
}

TEST(ExportParts, MeasuresWhatItWrote) {
  const ScratchFolder folder;
  const auto files = export_parts(
      drive().model(),
      {.folder = folder.path(),
       .formats = {FileFormat::kStl, FileFormat::k3mf, FileFormat::kObj, FileFormat::kPly, FileFormat::kGlb}});
  ASSERT_TRUE(files) << files.error().front().message;
  double parts_mm3 = 0.0;
  for (const Placement& body : drive().shapes.assembly)
    parts_mm3 += volume_mm3(drive().meshes[body.part].mesh);
  for (const ReportedFile& file : *files) {
    double expected_mm3 = parts_mm3;
    for (std::size_t i = 0; i < drive().shapes.parts.size(); ++i)
      if (drive().shapes.parts[i].name == file.part) expected_mm3 = volume_mm3(drive().meshes[i].mesh);
    EXPECT_NEAR(file.volume_mm3, expected_mm3, 1e-7 * expected_mm3) << file.path;
    EXPECT_GT(file.triangles, 1000U) << file.path;
    // meshed to 1 um; STL and GLB round to float
    EXPECT_LT(file.accuracy_um, 1.0 + 0.02) << file.path;
    EXPECT_GT(file.accuracy_um, 0.9) << file.path;
  }
}

// The figure is a measurement: a mesh that is worse than it was meant to be is told.
TEST(ExportParts, FindsAMeshThatMissesTheTrueSurface) {
  const ScratchFolder folder;
  std::vector<PartMesh> meshes = drive().meshes;
  for (auto& vertex : meshes[2].mesh.vertices) vertex[0] += 0.005;
  const ExportModel model{&drive().train, &drive().shapes, &meshes};
  const auto files = export_parts(model, {.folder = folder.path()});
  ASSERT_TRUE(files);
  for (const ReportedFile& file : *files) {
    const bool moved = file.part == "ring1" || file.part == "assembly";
    EXPECT_NEAR(file.accuracy_um, moved ? 5.5 : 1.0, moved ? 0.6 : 0.1) << file.path;
  }
}

TEST(ExportParts, GivesTheSameBytesInEveryRun) {
  const ScratchFolder folder;
  const auto first = export_parts(drive().model(), {.folder = folder / "a", .formats = file_formats()});
  const auto second = export_parts(drive().model(), {.folder = folder / "b", .formats = file_formats()});
  ASSERT_TRUE(first && second);
  for (const ReportedFile& file : *first)
    EXPECT_TRUE(read_file(folder / "a" / file.path).value() == read_file(folder / "b" / file.path).value())
        << file.path;
}

TEST(ExportParts, WritesOnePartAlone) {
  const ScratchFolder folder;
  const auto files = export_parts(drive().model(), {.folder = folder.path(), .part = "ring1"});
  ASSERT_TRUE(files);
  EXPECT_EQ(folder.entries(), 2U);
  EXPECT_TRUE(fs::exists(folder / "ring1.stl"));
}

TEST(ExportParts, WritesNoAssemblyOfASingleGear) {
  const ScratchFolder folder;
  const Example example("pinion_8_undercut");
  const auto files = export_parts(example.model(), {.folder = folder.path()});
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ(files->front().path, "gear.stl");
}

TEST(ExportParts, NamesThePartsThereAre) {
  const ScratchFolder folder;
  const auto files = export_parts(drive().model(), {.folder = folder / "x", .part = "ring3"});
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().front().code, ErrorCode::kUsage);
  EXPECT_EQ(files.error().front().remedy, "sun, planet, ring1, ring2");
  EXPECT_FALSE(fs::exists(folder / "x"));
}

TEST(ExportParts, ReportsAFolderThatCannotBe) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "file", "x"));
  const auto files = export_parts(drive().model(), {.folder = folder / "file" / "inner"});
  ASSERT_FALSE(files);
  EXPECT_EQ(exit_code(files.error().front().code), 3);
}

TEST(ExportParts, LeavesNothingHalfWrittenWhereAFileCannotBe) {
  const ScratchFolder folder;
  fs::create_directory(folder / "ring1.stl");  // in the way
  const auto files = export_parts(drive().model(), {.folder = folder.path()});
  ASSERT_FALSE(files);
  EXPECT_NE(files.error().front().message.find("ring1.stl"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.is_directory()) continue;
    EXPECT_TRUE(read_mesh(entry.path())) << entry.path();
  }
}

TEST(ExportParts, ShowsEveryFileAsProgress) {
  const ScratchFolder folder;
  std::set<std::string> shown;
  const auto files = export_parts(drive().model(), {.folder = folder.path(),
                                                    .formats = {FileFormat::kSvg},
                                                    .on_written = [&](const std::string& name) {
                                                      shown.insert(name);
                                                    }});
  ASSERT_TRUE(files);
  EXPECT_EQ(shown.size(), files->size());
}

TEST(ParseFormats, TakesAListAndRefusesUnknownOnes) {
  using enum FileFormat;
  EXPECT_EQ(parse_formats({"stl", "3mf", "step", "stl"}).value(), (std::vector{kStl, k3mf, kStep}));
  // unasked all but those that must be asked for: pictures
  std::string unasked;
  const std::vector<FileFormat> without_pictures = parse_formats({}).value();
  for (const FileFormat format : without_pictures)
    unasked += std::string(unasked.empty() ? "" : " ") + to_text(format);
  EXPECT_EQ(unasked, "stl 3mf obj ply glb step dxf svg scad pdf");
  EXPECT_EQ(unasked + " " + asked_format_names(" "), format_names(" "));
  const auto formats = parse_formats({"STL", "obj", "", "iges"});
  ASSERT_FALSE(formats);
  EXPECT_EQ(formats.error().size(), 3U);
  EXPECT_EQ(formats.error().front().code, ErrorCode::kUsage);
  EXPECT_EQ(formats.error().front().remedy, format_names(", "));
}

TEST(FileFormats, TheTableStandsInTheOrderOfTheEnumeration) {
  const auto& table = file_format_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(table[i].format), i);
    EXPECT_EQ(&info(table[i].format), &table[i]);
    EXPECT_EQ(to_text(table[i].format), std::string(table[i].name));
    EXPECT_FALSE(table[i].description.empty());
  }
  EXPECT_EQ(static_cast<std::size_t>(FileFormat::kApng) + 1, table.size());
  EXPECT_EQ(format_names(",", FormatContent::kMesh), "stl,3mf,obj,ply,glb");
}

TEST(FileFormats, PicturesAreWrittenWhereTheyAreAskedFor) {
  EXPECT_EQ(asked_format_names(","), "png,apng");
  const auto unasked = *parse_formats({});
  EXPECT_EQ(unasked.size() + 2, file_formats().size());
  EXPECT_EQ(std::count(unasked.begin(), unasked.end(), FileFormat::kPng), 0);
  EXPECT_EQ(parse_formats({"png", "png"}), std::vector<FileFormat>{FileFormat::kPng});
}

}  // namespace
}  // namespace trueflank::io
