// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scratch_folder.h"
#include "trueflank/report/render/gearbox_pictures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "trueflank/design/design_file.h"

namespace trueflank::io {
namespace {

struct Pictured {
  explicit Pictured(const std::string& example) {
    const auto file = read_design_file(std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + example +
                                       "/design.toml");
    EXPECT_TRUE(file.has_value());
    train = std::make_unique<const GearTrain>(*lay_out(file->design));
    shapes = *part_shapes(*train);
  }
  std::unique_ptr<const GearTrain> train;
  PartShapes shapes;
};

/// Pixels whose hue is that of a part: brightest channel, and the darkest one well below.
int count_like(const Image& image, std::size_t most, std::size_t least) {
  int count = 0;
  for (const auto& pixel : image.pixels) {
    const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
    count += high - low > 50 && pixel[most] == high && pixel[least] == low ? 1 : 0;
  }
  return count;
}

TEST(GearboxPictures, TheCutShowsSunAndPlanets) {
  for (const char* example :
       {"bilateral_drive", "printed_actuator", "simple_planetary", "stepped"}) {
    const Pictured p(example);
    const Image image = GearboxPictures(*p.train, p.shapes, 240).assembly(240, 180);
    EXPECT_GT(count_like(image, 0, 2), 40) << example;   // the golden sun, and red or orange parts
    EXPECT_GT(count_like(image, 2, 0), 400) << example;  // blue planets
  }
}

TEST(GearboxPictures, WritesEveryMadePartAndTheAssembly) {
  const Pictured p("simple_planetary");
  const test::ScratchFolder scratch;
  const auto& folder = scratch.path();
  const auto files =
      write_pictures(*p.train, p.shapes, {.folder = folder, .part = "", .width_px = 120});
  ASSERT_TRUE(files.has_value());
  EXPECT_EQ(files->size(), p.shapes.parts.size() + 1);
  EXPECT_EQ(files->back().path, "assembly.png");
  for (const ReportedFile& file : *files) {
    EXPECT_TRUE(std::filesystem::exists(folder / file.path)) << file.path;
    EXPECT_EQ(file.bytes, std::filesystem::file_size(folder / file.path));
  }
  const auto sun =
      write_pictures(*p.train, p.shapes, {.folder = folder, .part = "sun", .width_px = 120});
  ASSERT_TRUE(sun.has_value());
  ASSERT_EQ(sun->size(), 1U);
  EXPECT_EQ(sun->front().path, "sun.png");
  std::filesystem::remove_all(folder);
}

TEST(GearboxPictures, ARowOfPicturesGoesRoundOnce) {
  const Pictured p("simple_planetary");
  const GearboxPictures pictures(*p.train, p.shapes, 80);
  const auto row = pictures.turning(80, 60, 3);
  ASSERT_EQ(row.size(), 3U);
  EXPECT_NE(row[0], row[1]);
  EXPECT_EQ(row[0], pictures.turning(80, 60, 1)[0]);
}

}  // namespace
}  // namespace trueflank::io
