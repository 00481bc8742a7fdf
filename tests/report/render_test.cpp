// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/render.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "trueflank/base/units.h"
#include "trueflank/export/packed/deflate.h"
#include "trueflank/report/render/png.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank::io {
namespace {

/// A tube of two slabs with a hole beside the axis: inside, outside and steps.
PicturedMesh tube() {
  PartShape shape{.name = "tube", .slabs = {}};
  const Outline bore = CircleOutline{.radius_mm = 4.0};
  shape.slabs.push_back({0.0,
                         3.0,
                         CircleOutline{.radius_mm = 10.0},
                         {bore, CircleOutline{.centre = {7.0, 0.5}, .radius_mm = 1.0}}});
  shape.slabs.push_back({3.0, 8.0, CircleOutline{.radius_mm = 6.0}, {bore}});
  return pictured_mesh(part_mesh(shape, {.tolerance_mm = 0.06}).mesh);
}

struct Crossing {
  double nearness;
  bool back;
};

/// A triangle of a body where that is placed.
struct PlacedTriangle {
  std::array<Eigen::Vector3d, 3> p;
  Eigen::Vector3d n;
  Eigen::Vector3d middle;
  double reach_square = 0.0;  ///< no corner is farther from the middle
};

std::vector<PlacedTriangle> placed_triangles(const RasterBody& body) {
  std::vector<PlacedTriangle> placed;
  for (const auto& corners : body.mesh->mesh.triangles) {
    PlacedTriangle t;
    for (std::size_t k = 0; k < 3; ++k) t.p[k] = body.place(body.mesh->mesh.vertices[corners[k]]);
    t.n = (t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]);
    t.middle = (t.p[0] + t.p[1] + t.p[2]) / 3.0;
    for (const Eigen::Vector3d& p : t.p) t.reach_square = std::max(t.reach_square, (p - t.middle).squaredNorm());
    placed.push_back(t);
  }
  return placed;
}

/// Where a line of sight crosses a body, by plain intersection with every triangle that it does not pass far off.
std::vector<Crossing> crossings(const std::vector<PlacedTriangle>& body, const View& view, double x, double y) {
  const Eigen::Vector3d from = view.unproject(x, y, 1.0), to = view.unproject(x, y, 0.001);
  const Eigen::Vector3d way = (to - from).normalized();
  std::vector<Crossing> found;
  for (const auto& [p, n, middle, reach_square] : body) {
    if (way.cross(middle - from).squaredNorm() > 1.001 * reach_square) continue;
    const double slope = n.dot(way);
    if (slope == 0.0) continue;
    const Eigen::Vector3d at = from + n.dot(p[0] - from) / slope * way;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside && n.dot((p[(k + 1) % 3] - p[k]).cross(at - p[k])) >= 0.0;
    if (inside) found.push_back({view.project(at).z(), slope > 0.0});
  }
  return found;
}

/// Nearness of what a line of sight meets first, the wedge taken away.
double first_seen(const std::vector<PlacedTriangle>& body, const View& view, const Cutaway& cut, double x, double y) {
  double in = 1e300, out = -1e300;
  for (int i = 0; i < 2; ++i) {
    const ViewedPlane p = view.plane(cut.normal[static_cast<std::size_t>(i)], 0.0);
    const double at = -(p.a * x + p.b * y + p.c) / p.e;
    if (p.e > 0.0)
      out = std::max(out, at);
    else
      in = std::min(in, at);
  }
  double first = -1.0, behind = -1.0;
  bool inside = false;
  for (const Crossing& c : crossings(body, view, x, y)) {
    const bool removed = c.nearness < in && c.nearness > out;
    if (!removed) first = std::max(first, c.nearness);
    if (c.nearness <= out && c.nearness > behind) {
      behind = c.nearness;
      inside = c.back;
    }
  }
  if (out < in && inside) first = std::max(first, out);
  return first;
}

class CutTube : public ::testing::Test {
 protected:
  const PicturedMesh mesh = tube();
  const std::vector<RasterBody> bodies{{.mesh = &mesh,
                                        .cos = std::cos(0.3),
                                        .sin = std::sin(0.3),
                                        .move_mm = {0.2, -0.1, 1.0},
                                        .cut = true}};
  const Cutaway cut{
      .normal = {Eigen::Vector3d(0.8, 0.6, 0.0), Eigen::Vector3d(0.1, 0.99, 0.0).normalized()},
      .offset_mm = {0.0, 0.0}};
  [[nodiscard]] View view(double azimuth_rad) const {
    return View::perspective({azimuth_rad, 0.6}, {{0.0, 0.0, 4.0}, 12.0}, 5.0)
        .fitted({{-11.0, -11.0, 0.0}, {11.0, 11.0, 9.0}, {11.0, -11.0, 0.0}, {-11.0, 11.0, 0.0}},
                120, 120, 2);
  }
};

// the rasteriser against plain intersection of lines and triangles: surfaces, cut faces, nothing
TEST_F(CutTube, SamplesSeeWhatALineOfSightMeetsFirst) {
  const std::vector<PlacedTriangle> body = placed_triangles(bodies[0]);
  for (const double azimuth : {0.9, 2.4, -2.0, 0.1}) {
    const View seen_from = view(azimuth);
    const SightWindow window =
        Raster(bodies, seen_from, cut, SampleGrid::kShifted).draw(0, 0, 120, 120);
    int wrong = 0, faces = 0;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 120; ++x) {
        const Eigen::Vector2d at = Eigen::Vector2d(x, y) + sample_place(SampleGrid::kShifted, x, y);
        const double expected = first_seen(body, seen_from, cut, at.x(), at.y());
        const Sight& sight = window.at(x, y);
        const bool nothing = sight.surface == kNoSight.surface;
        if (!nothing && SurfaceName::is_cut_face(sight.surface)) ++faces;
        if (nothing != (expected < 0.0) || (!nothing && std::abs(sight.nearness - expected) > 2e-6))
          ++wrong;
      }
    // corners are rounded to 1/256 of a sample: at outlines one in a thousand samples may differ
    EXPECT_LE(wrong, 14) << azimuth;
    if (azimuth == 0.9) {
      EXPECT_GT(faces, 500);
    }
  }
}

TEST_F(CutTube, AWindowSeesTheSameWhateverItsSize) {
  Raster raster(bodies, view(0.9), cut, SampleGrid::kShifted);
  const SightWindow whole = raster.draw(0, 0, 120, 120);
  raster.sort_into_tiles(40, 3, 120, 120);
  for (int top = 0; top < 120; top += 40)
    for (int left = 0; left < 120; left += 40) {
      const SightWindow part = raster.draw(left, top, 40, 40);
      for (int y = top; y < top + 40; ++y)
        for (int x = left; x < left + 40; ++x)
          ASSERT_EQ(part.at(x, y).surface, whole.at(x, y).surface) << x << " " << y;
    }
}

TEST_F(CutTube, ThePictureIsTheSameEveryTime) {
  const std::vector<RenderedBody> shown{{.body = bodies[0], .finish = {.colour = {200, 60, 40}}}};
  const RenderOptions options{
      .width_px = 90, .height_px = 70, .from = {0.9, 0.6}, .cutaway = cut, .quick = true};
  const Image image = rendered(shown, options);
  EXPECT_EQ(image, rendered(shown, options));
  EXPECT_EQ(png_file(image), png_file(rendered(shown, options)));
}

TEST(Picture, GroundIsDarkBesideABodyAndLightFarAway) {
  const PicturedMesh mesh = tube();
  const Image image = rendered({{.body = {.mesh = &mesh}, .finish = {.colour = {200, 60, 40}}}},
                               {.width_px = 160, .height_px = 120, .from = {0.0, 0.7}});
  const auto grey = [](const std::array<std::uint8_t, 3>& p) { return std::abs(p[0] - p[2]) < 8; };
  EXPECT_GT(image.at(0, 0)[0], 235);
  int darkest = 255;
  for (const auto& pixel : image.pixels)
    if (grey(pixel)) darkest = std::min<int>(darkest, pixel[0]);
  EXPECT_LT(darkest, 190);
  // the body itself, red, in the middle of its upper face
  int red = 0;
  for (const auto& pixel : image.pixels) red += pixel[0] > pixel[2] + 60 ? 1 : 0;
  EXPECT_GT(red, 3000);
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// The pixels of one of our files, by the rules of the standard.
Image read_png(const std::string& file) {
  Image image;
  std::string packed;
  for (std::size_t at = 8; at < file.size();) {
    const std::uint32_t size = big_endian(file, at);
    const std::string type = file.substr(at + 4, 4), content = file.substr(at + 8, size);
    EXPECT_EQ(checksum(type + content), big_endian(file, at + 8 + size)) << type;
    if (type == "IHDR") {
      image.width_px = static_cast<int>(big_endian(content, 0));
      image.height_px = static_cast<int>(big_endian(content, 4));
    }
    if (type == "IDAT") packed += content;
    at += 12 + size;
  }
  const std::size_t row = 3 * static_cast<std::size_t>(image.width_px);
  std::string rows((row + 1) * static_cast<std::size_t>(image.height_px), '\0');
  EXPECT_TRUE(inflate(std::string_view(packed).substr(2, packed.size() - 6), rows));
  std::vector<int> above(row, 0), now(row, 0);
  for (int y = 0; y < image.height_px; ++y) {
    const std::size_t start = (row + 1) * static_cast<std::size_t>(y);
    for (std::size_t i = 0; i < row; ++i) {
      const int a = i < 3 ? 0 : now[i - 3], b = above[i], c = i < 3 ? 0 : above[i - 3];
      const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
      const std::array<int, 5> predicted{0, a, b, (a + b) / 2,
                                        pa <= pb && pa <= pc ? a
                                        : pb <= pc           ? b
                                                             : c};
      now[i] = (static_cast<unsigned char>(rows[start + 1 + i]) +
                predicted[static_cast<std::size_t>(rows[start])]) &
               255;
    }
    for (std::size_t i = 0; i < row; i += 3)
      image.pixels.push_back({static_cast<std::uint8_t>(now[i]),
                              static_cast<std::uint8_t>(now[i + 1]),
                              static_cast<std::uint8_t>(now[i + 2])});
    above = now;
  }
  return image;
}

TEST(Png, HoldsThePixels) {
  std::mt19937 random(1);
  Image image{.width_px = 37, .height_px = 23};
  for (int i = 0; i < 37 * 23; ++i)
    image.pixels.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 37 * 9),
                            static_cast<std::uint8_t>(i % 5 == 0 ? random() : 80)});
  EXPECT_EQ(read_png(png_file(image)), image);
  const Image one{.width_px = 1, .height_px = 1, .pixels = {{1, 2, 3}}};
  EXPECT_EQ(read_png(png_file(one)), one);
}

TEST(Png, AnAnimationCountsItsPicturesAndChunks) {
  const Image dark{.width_px = 2, .height_px = 1, .pixels = {{1, 2, 3}, {4, 5, 6}}},
      light{.width_px = 2, .height_px = 1, .pixels = {{201, 202, 203}, {204, 205, 206}}};
  const std::string file = animated_png_file({dark, light, dark}, 150);
  EXPECT_EQ(read_png(file), dark);  // what programs show that play nothing
  std::uint32_t number = 0, frames = 0;
  for (std::size_t at = 8; at < file.size(); at += 12 + big_endian(file, at)) {
    const std::string type = file.substr(at + 4, 4);
    if (type == "acTL") {
      EXPECT_EQ(big_endian(file, at + 8), 3U);
    }
    if (type == "fcTL" || type == "fdAT") {
      EXPECT_EQ(big_endian(file, at + 8), number++);
    }
    if (type == "fcTL") ++frames;
  }
  EXPECT_EQ(frames, 3U);
  EXPECT_EQ(number, 5U);
}

}  // namespace
}  // namespace trueflank::io
