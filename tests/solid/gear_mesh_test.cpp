// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/gear_mesh.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/solid/random_part.h"
#include "tests/train/prototype_design.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

using Vertex = std::array<double, 3>;

double facing_up(const Vertex& a, const Vertex& b, const Vertex& c) {
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

GearboxDesign prototype_with_everything() {
  GearboxDesign design = test::prototype(0.5225, 1.9967, 25.6826);
  design.backlash_mm = 0.05;
  design.gears[0].bore = {.diameter_mm = 5.0};
  design.gears[1].bore = {
      .diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 2.0, .keyway_depth_mm = 1.0};
  design.gears[2].bolt_circle = {.count = 6, .circle_diameter_mm = 99.0, .hole_diameter_mm = 3.2};
  return design;
}

TEST(GearMesh, IsAskedForATenthOfTheThinnestWall) {
  const auto circle = [](double x, double y, double r) { return CircleOutline{.centre = {x, y}, .radius_mm = r}; };
  const auto asked = [&](const CircleOutline& second, double tolerance_mm = 10.0) {
    const Slab disk{.z_lower_mm = 0.0, .z_upper_mm = 2.0, .outer = circle(0.0, 0.0, 20.0), .holes = {circle(10.0, 0.0, 3.0), second}};
    return meshing_tolerance_mm({.name = "disk", .slabs = {disk}}, tolerance_mm);
  };
  EXPECT_NEAR(asked(circle(-10.0, 0.0, 2.0)), 0.7, 1e-12);   // the first hole and the rim
  EXPECT_NEAR(asked(circle(15.4, 0.0, 2.0)), 0.04, 1e-12);   // hole and hole
  EXPECT_NEAR(asked(circle(0.0, 17.7, 2.0)), 0.03, 1e-12);   // the second hole and the rim
  EXPECT_EQ(asked(circle(0.0, 17.7, 2.0), 0.01), 0.01);
  // a collar that stands on the disk around its hole, and one as wide as the disk
  for (const double collar : {3.25, 20.0}) {
    const Slab disk{.z_lower_mm = 0.0, .z_upper_mm = 2.0, .outer = circle(0.0, 0.0, 20.0), .holes = {circle(0.0, 0.0, 3.0)}};
    const Slab above{.z_lower_mm = 2.0, .z_upper_mm = 3.0, .outer = circle(0.0, 0.0, collar), .holes = {circle(0.0, 0.0, 3.0)}};
    EXPECT_NEAR(meshing_tolerance_mm({.name = "collar", .slabs = {disk, above}}, 10.0), 0.1 * (collar - 3.0), 1e-12);
  }
}

TEST(GearMesh, EveryPartOfThePrototypeIsOneClosedOutwardShell) {
  const auto train = lay_out(prototype_with_everything());
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  ASSERT_EQ(shapes->parts.size(), 4U);  // the planet is one body
  for (const PartShape& part : shapes->parts) {
    const PartMesh made = part_mesh(part);
    const MeshValidity validity = mesh_validity(made.mesh);
    EXPECT_TRUE(validity.valid()) << part.name;
    EXPECT_EQ(validity.components, 1U) << part.name;
    EXPECT_EQ(validity.unused_vertices, 0U) << part.name;
    EXPECT_LE(made.chord_error_mm, 1e-3) << part.name;
    EXPECT_GT(made.chord_error_mm, 0.5e-3) << part.name;
  }
}

/// Area of a section by the wall's own lower edges (Green), independent of the plane faces.
double area_of_lower_edges(const TriangleMesh& mesh, double z) {
  long double twice = 0.0L;
  for (const auto& t : mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const Vertex &a = mesh.vertices[t[e]], &b = mesh.vertices[t[(e + 1) % 3]];
      if (a[2] == z && b[2] == z && mesh.vertices[t[(e + 2) % 3]][2] > z)
        twice += static_cast<long double>(a[0]) * b[1] - static_cast<long double>(a[1]) * b[0];
    }
  return static_cast<double>(0.5L * twice);
}

TEST(GearMesh, RandomPartsAreValidAndTheirFacesCoverTheirSectionsOnce) {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 160; ++seed) {
    const auto random = test::random_part(seed);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    ++made;
    const PartMesh result = part_mesh(random->part, {.tolerance_mm = random->tolerance_mm});
    const TriangleMesh& mesh = result.mesh;
    EXPECT_LE(result.chord_error_mm, random->tolerance_mm);
    const MeshValidity validity = mesh_validity(mesh);
    EXPECT_TRUE(validity.valid());
    EXPECT_EQ(validity.components, 1U);
    EXPECT_EQ(validity.unused_vertices, 0U);
    EXPECT_GT(validity.smallest_altitude_mm, std::min(0.04 * random->tolerance_mm, 1e-3));
    // no triangle of a face is turned over and their areas add up: they do not overlap
    const double top = random->part.slabs.back().z_upper_mm;
    double covered = 0.0;
    bool turned_over = false;
    for (const auto& t : mesh.triangles) {
      const Vertex &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      if (a[2] != b[2] || b[2] != c[2]) continue;
      const double area = facing_up(a, b, c);
      turned_over = turned_over || (a[2] == top ? area <= 0.0 : area >= 0.0);
      if (a[2] == top) covered += area;
    }
    EXPECT_FALSE(turned_over);
    const double section = area_of_lower_edges(mesh, 0.0);
    EXPECT_NEAR(covered / section, 1.0, 1e-11);
    EXPECT_NEAR(validity.volume_mm3 / (section * top), 1.0, 1e-12);
  }
  EXPECT_GT(made, 130);
}

TEST(GearMesh, ThirtyTwoBitCoordinatesMergeNothingAndLeaveNoTriangleWithoutArea) {
  for (std::uint64_t seed = 1000; seed < 1120; ++seed) {
    auto random = test::random_part(seed);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    // 32 bits resolve 0.03 um at 300 mm: no finer tolerance makes sense there
    const double size = extent(random->part.slabs[0].outer).outer_radius_mm;
    TriangleMesh mesh =
        part_mesh(random->part, {.tolerance_mm = std::max(random->tolerance_mm, 1e-6 * size)}).mesh;
    for (Vertex& v : mesh.vertices)
      for (double& x : v) x = static_cast<double>(static_cast<float>(x));
    std::map<Vertex, int> places;
    for (const Vertex& v : mesh.vertices) ++places[v];
    EXPECT_EQ(places.size(), mesh.vertices.size());
    EXPECT_TRUE(mesh_validity(mesh).valid());
  }
}

TEST(GearMesh, SpurGearHasTheVolumeOfItsPolygonTimesItsWidth) {
  GearboxDesign design = test::unshifted("gear", "", {39});
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  const PartMesh made = part_mesh(shapes->parts[0], {.tolerance_mm = 1e-3});
  const SectionPolygon polygon = section_polygon(train->gears[0].profile, 1e-3);
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.points.size(); ++i)
    area += 0.5 * cross(polygon.points[i], polygon.points[(i + 1) % polygon.points.size()]);
  EXPECT_NEAR(volume_mm3(made.mesh) / (area * 10.0), 1.0, 1e-12);
}

TEST(GearMesh, CompoundPlanetIsTheSumOfItsSlabs) {
  const auto train = lay_out(prototype_with_everything());
  const auto shapes = part_shapes(*train);
  const PartShape& planet = shapes->parts[1];
  ASSERT_EQ(planet.name, "planet");
  ASSERT_EQ(planet.slabs.size(), 3U);
  double sum = 0.0;
  for (const Slab& slab : planet.slabs) {
    PartShape alone{.name = "slab", .slabs = {slab}};
    sum += volume_mm3(part_mesh(alone).mesh);
  }
  EXPECT_NEAR(volume_mm3(part_mesh(planet).mesh) / sum, 1.0, 1e-12);
}

TEST(GearMesh, TrianglesGrowLinearlyWithTheChordsTheToleranceAsksFor) {
  const auto train = lay_out(prototype_with_everything());
  const auto shapes = part_shapes(*train);
  const auto count = [&](double tolerance_mm) {
    return static_cast<double>(
        part_mesh(shapes->parts[0], {.tolerance_mm = tolerance_mm}).mesh.triangles.size());
  };
  EXPECT_NEAR(count(1e-5) / count(1e-3), 10.0, 0.7);  // chords go with the root of the tolerance
}

TEST(GearMesh, SameInputGivesTheSameMesh) {
  const auto train = lay_out(prototype_with_everything());
  const auto shapes = part_shapes(*train);
  const PartMesh first = part_mesh(shapes->parts[1]), second = part_mesh(shapes->parts[1]);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
}

}  // namespace
}  // namespace trueflank
