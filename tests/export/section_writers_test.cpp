// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>

#include "tests/export/sample_scene.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/export/section/dxf_writer.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/section/section_contour.h"
#include "trueflank/export/section/svg_writer.h"

namespace trueflank::io {
namespace {

using test::ScratchFolder;

/// Area within the arcs: shoelace and the segments between chords and arcs.
double area_mm2(const Contour& contour) {
  if (contour.circle) return kPi * contour.circle->radius_mm * contour.circle->radius_mm;
  double area = 0.0;
  for (std::size_t i = 0; i < contour.vertices.size(); ++i) {
    const ContourVertex& v = contour.vertices[i];
    const Point2& next = contour.vertices[(i + 1) % contour.vertices.size()].point;
    area += 0.5 * cross(v.point, next);
    const double angle = 4.0 * std::atan(v.bulge);
    if (angle == 0.0) continue;
    const double radius = 0.5 * (next - v.point).norm() / std::sin(0.5 * angle);
    area += 0.5 * radius * radius * (angle - std::sin(angle));
  }
  return area;
}

/// Points on every edge's arc at a quarter, half and three quarters of its angle.
std::vector<Point2> arc_points(const Contour& contour) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < contour.vertices.size(); ++i) {
    const ContourVertex& v = contour.vertices[i];
    const Point2 chord = contour.vertices[(i + 1) % contour.vertices.size()].point - v.point;
    const double angle = 4.0 * std::atan(v.bulge);
    for (const double share : {0.25, 0.5, 0.75}) {
      // the chord to a point of the arc is turned against the whole chord by the arc left, halved
      const double length = angle == 0.0 ? share * chord.norm()
                                         : chord.norm() * std::sin(0.5 * share * angle) /
                                               std::sin(0.5 * angle);
      points.push_back(v.point +
                       length * rotated(chord.normalized(), -0.5 * (1.0 - share) * angle));
    }
  }
  return points;
}

/// Distance of a point of tooth 1 to the profile's curves, by dense sampling and a parabola.
double distance_mm(const ToothProfile& profile, Point2 p) {
  if (p.y() < 0.0) p = mirrored(p);
  double nearest = 1e9;
  for (const ProfilePiece& piece : profile.pieces()) {
    const Curve& c = piece.curve;
    double low = c.begin, high = c.end;
    for (int round = 0; round < 12; ++round) {  // narrow the interval around the nearest sample
      int best = 0;
      double least = 1e9;
      for (int i = 0; i <= 40; ++i) {
        const double d = (point_at(c, low + (high - low) * i / 40) - p).norm();
        if (d < least) least = d, best = i;
      }
      nearest = std::min(nearest, least);
      const double step = (high - low) / 40, at = low + step * best;
      const double bottom = std::min(c.begin, c.end), top = std::max(c.begin, c.end);
      low = std::clamp(at - step, bottom, top);
      high = std::clamp(at + step, bottom, top);
    }
  }
  return nearest;
}

TEST(SectionContour, VerticesLieOnTheTrueCurveAndArcsMuchNearerThanTheTolerance) {
  constexpr double kContour_mm = 1e-3;
  for (const auto& sample : test::sample_gears()) {
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile) << sample.name;
    const Contour contour = contour_of(ToothedOutline{&*profile, 0.0}, kContour_mm);
    const std::size_t per_tooth = contour.vertices.size() / sample.gear.teeth;
    ASSERT_EQ(per_tooth * sample.gear.teeth, contour.vertices.size());
    double vertex_mm = 0.0, arc_mm = 0.0;
    for (std::size_t i = 0; i < per_tooth; ++i)
      vertex_mm = std::max(vertex_mm, distance_mm(*profile, contour.vertices[i].point));
    const auto arcs = arc_points(contour);
    for (std::size_t i = 0; i + 3 < 3 * per_tooth; ++i)
      arc_mm = std::max(arc_mm, distance_mm(*profile, arcs[i]));
    EXPECT_LT(vertex_mm, 1e-7) << sample.name;
    EXPECT_LT(arc_mm, 0.2 * kContour_mm) << sample.name;
  }
}

TEST(SectionContour, EnclosesTheAreaOfTheTrueCurve) {
  for (const auto& sample : test::sample_gears()) {
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile) << sample.name;
    const ToothedOutline outline{&*profile, 0.4};
    const double exact = test::area_mm2(outline);
    EXPECT_NEAR(area_mm2(contour_of(outline, 1e-3)), exact, 5e-6 * exact) << sample.name;
  }
}

TEST(SectionContour, BoresAreExact) {
  const std::vector<BoreDesign> bores = {
      {.diameter_mm = 8.0},
      {.diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 3.0, .keyway_depth_mm = 1.4},
      {.diameter_mm = 8.0, .kind = BoreKind::kDFlat, .d_flat_mm = 7.2},
      {.diameter_mm = 8.0, .kind = BoreKind::kDFlat, .d_flat_mm = 3.0},
      {.diameter_mm = 8.0, .kind = BoreKind::kHex}};
  for (const BoreDesign& bore : bores)
    EXPECT_NEAR(area_mm2(contour_of(BoreOutline{bore}, 1e-3)), test::area_mm2(BoreOutline{bore}), 1e-9);
  EXPECT_TRUE(contour_of(BoreOutline{bores[0]}, 1e-3).circle.has_value());
}

/// Two layers of teeth as in a 3K drive: a compound planet in two rings, made by hand.
struct SampleDrive {
  ToothProfile planet1 = ToothProfile::make(test::external_gear(20, 0.1)).value();
  ToothProfile planet2 = ToothProfile::make(test::external_gear(17, 0.1)).value();
  ToothProfile ring1 = ToothProfile::make(test::ring_gear(60, 0.1)).value();
  ToothProfile ring2 = ToothProfile::make(test::ring_gear(57, 0.1)).value();
  PartShapes shapes;
  SampleDrive() {
    shapes.parts = {test::planet_part(planet1, planet2), test::ring_part("ring1", ring1, 10.0),
                    test::ring_part("ring2", ring2, 9.0)};
    shapes.assembly = {{.part = 0, .name = "planet 1", .translation_mm = {20.0, 0.0, 0.0}},
                       {.part = 0, .name = "planet 2", .rotation_rad = 1.0,
                        .translation_mm = {-20.0, 0.0, 0.0}},
                       {.part = 1, .name = "ring1"},
                       {.part = 2, .name = "ring2", .translation_mm = {0.0, 0.0, 11.0}}};
  }
};

TEST(AssemblySections, ShowOneSectionALayerOfTeeth) {
  const SampleDrive drive;
  const auto sections = assembly_sections(drive.shapes, 1e-3);
  ASSERT_EQ(sections.size(), 3U);  // the index mark makes the top of the upper layer another section
  EXPECT_EQ(sections[0].bodies.size(), 3U);
  EXPECT_EQ(sections[0].z_lower_mm, 0.0);
  EXPECT_EQ(sections[0].z_upper_mm, 10.0);
  EXPECT_EQ(sections[1].bodies.size(), 3U);
  EXPECT_EQ(sections[1].bodies[2].name, "ring2");
}

TEST(AssemblySections, PlaceEveryBody) {
  const SampleDrive drive;
  const Section section = assembly_sections(drive.shapes, 1e-3)[0];
  const SectionBody& planet = section.bodies[1];
  ASSERT_EQ(planet.holes.size(), 1U);
  EXPECT_NEAR(planet.holes[0].circle->centre.x(), -20.0, 1e-12);
  // tooth 1 points to where the body is turned: the middle of its tip
  double nearest = 1e9;
  const Point2 tip = Point2(-20.0, 0.0) + drive.planet1.tip_radius_mm() * unit_vector(1.0);
  for (const Point2& p : arc_points(planet.outer)) nearest = std::min(nearest, (p - tip).norm());
  for (const auto& v : planet.outer.vertices) nearest = std::min(nearest, (v.point - tip).norm());
  EXPECT_LT(nearest, 1e-9);
}

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(DxfWriter, WritesOneClosedEntityAnOutline) {
  const ScratchFolder folder;
  const SampleDrive drive;
  ASSERT_TRUE(write_dxf(folder / "a.dxf", part_sections(drive.shapes.parts[0], 1e-3)));
  const std::string text = read_file(folder / "a.dxf").value();
  EXPECT_EQ(count(text, "\nAcDbPolyline\n"), 3);     // teeth below, teeth above twice
  EXPECT_EQ(count(text, "\nCIRCLE\n"), 1 + 4 + 1);   // neck, bores, mark
  EXPECT_EQ(count(text, "\nSECTION_2_PLANET\n"), 1 + 2);
  EXPECT_EQ(count(text, "$INSUNITS\n70\n4\n"), 1);
  EXPECT_TRUE(text.ends_with("0\nEOF\n"));
}

/// Area within the M ... L ... Z of a path.
double path_area_mm2(std::string_view data) {
  std::vector<Point2> points;
  const char* at = data.data() + 1;
  const char* end = data.data() + data.size();
  while (at < end && *at != 'Z') {
    if (*at == 'L' || *at == ' ') ++at;
    Point2 p;
    at = std::from_chars(at, end, p.x()).ptr + 1;
    at = std::from_chars(at, end, p.y()).ptr;
    points.push_back(p);
  }
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    area += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
  return area;
}

TEST(SvgWriter, IsTrueToSizeAndKeepsTheFrame) {
  const ScratchFolder folder;
  const ToothProfile profile = ToothProfile::make(test::external_gear(20, 0.0)).value();
  const PartShape part = test::gear_part("sun", profile, 5.0, {BoreOutline{{.diameter_mm = 6.0}}});
  ASSERT_TRUE(write_svg(folder / "a.svg", "a <gear>", part_sections(part, 1e-3)));
  const std::string text = read_file(folder / "a.svg").value();
  EXPECT_NE(text.find("width=\"26mm\" height=\"26mm\" viewBox=\"0 0 26 26\""), std::string::npos)
      << text.substr(0, 200);  // 22 mm over the tips and 2 mm around
  EXPECT_NE(text.find("a &lt;gear&gt;"), std::string::npos);
  EXPECT_NE(text.find("translate(13 13) scale(1 -1)"), std::string::npos);
  EXPECT_NE(text.find("<circle cx=\"0\" cy=\"0\" r=\"3\"/>"), std::string::npos);
  ASSERT_EQ(count(text, "<path d="), 1);
  const std::size_t begin = text.find("<path d=\"") + 9;
  const double exact = test::area_mm2(ToothedOutline{&profile, 0.0});
  // chords lose at most the tolerance along the outline
  EXPECT_NEAR(path_area_mm2(std::string_view(text).substr(begin, text.find('"', begin) - begin)), exact,
              1e-3 * 150.0);
}

TEST(SectionWriters, GiveTheSameBytesTwiceAndReportAFullDisk) {
  const ScratchFolder folder;
  const SampleDrive drive;
  const auto sections = assembly_sections(drive.shapes, 1e-3);
  ASSERT_TRUE(write_dxf(folder / "a", sections));
  ASSERT_TRUE(write_dxf(folder / "b", sections));
  EXPECT_EQ(read_file(folder / "a").value(), read_file(folder / "b").value());
  ASSERT_TRUE(write_svg(folder / "a", "t", sections));
  ASSERT_TRUE(write_svg(folder / "b", "t", sections));
  EXPECT_EQ(read_file(folder / "a").value(), read_file(folder / "b").value());
  EXPECT_EQ(write_dxf("/dev/full", sections).error().code, ErrorCode::kDisk);
  EXPECT_EQ(write_svg("/dev/full", "t", sections).error().code, ErrorCode::kDisk);
}

}  // namespace
}  // namespace trueflank::io
