// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/toothing_grid.h"

#include <gtest/gtest.h>

#include "tests/solid/random_toothing.h"
#include "tests/train/prototype_design.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/measure/triangle_tree.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/flank_strips.h"

namespace trueflank {
namespace {

using test::RandomNumbers;
using test::RandomToothing;
using test::ToothingKinds;

constexpr std::array kKinds = {ToothingKinds{}, ToothingKinds{.deviation = true},
                               ToothingKinds{.displacement = true}, ToothingKinds{.chamfer = true},
                               ToothingKinds{true, true, true}};

/// Facets of the toothing: steep, and with all corners on its walls.
std::vector<std::array<Point3, 3>> wall_facets(const TriangleMesh& mesh, RandomToothing& random) {
  const ToothProfile& profile = *random.outline().profile;
  const double low = std::min(profile.root_radius_mm(), profile.tip_radius_mm());
  const double high = std::max(profile.root_radius_mm(), profile.tip_radius_mm());
  const double margin = 0.05 * profile.gear().normal_module_mm;
  std::vector<std::array<Point3, 3>> facets;
  for (const auto& t : mesh.triangles) {
    std::array<Point3, 3> c;
    bool toothed = true;
    for (std::size_t i = 0; i < 3; ++i) {
      c[i] = Point3(mesh.vertices[t[i]].data());
      const double r = c[i].head<2>().norm();
      toothed = toothed && r > low - margin && r < high + margin;
    }
    const Point3 normal = (c[1] - c[0]).cross(c[2] - c[0]);
    if (toothed && normal.head<2>().norm() > 0.1 * normal.norm()) facets.push_back(c);
  }
  return facets;
}

class RandomToothings : public testing::TestWithParam<std::size_t> {};

TEST_P(RandomToothings, AreClosedAndKeepTheToleranceBothWays) {
  const ToothingKinds kinds = kKinds[GetParam()];
  int made = 0, worst_within = 0;
  const int wanted = kinds.chamfer ? 3 : 8;
  for (std::uint64_t seed = 100 * GetParam(); made < wanted; ++seed) {
    auto random = test::random_toothing(seed, kinds);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    ++made;
    const PartMesh result = part_mesh(random->part, {.tolerance_mm = random->tolerance_mm});
    EXPECT_LE(result.chord_error_mm, random->tolerance_mm);
    const MeshValidity validity = mesh_validity(result.mesh);
    EXPECT_TRUE(validity.valid());
    EXPECT_EQ(validity.components, 1U);
    EXPECT_EQ(validity.unused_vertices, 0U);

    const Toothing toothing = random->outline().toothing();
    RandomNumbers numbers(seed);
    const auto facets = wall_facets(result.mesh, *random);
    ASSERT_FALSE(facets.empty());
    double off_surface = 0.0;
    for (int i = 0; i < 100; ++i) {
      const auto& c = facets[static_cast<std::size_t>(numbers.between(0.0, 1.0) * static_cast<double>(facets.size()))];
      double u = numbers.between(0.0, 1.0), v = numbers.between(0.0, 1.0);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      if (i % 2 == 0) v = 0.0, u = 0.5;
      off_surface = std::max(off_surface, test::searched_distance_mm(
                                              toothing, c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0])));
    }
    EXPECT_LE(off_surface, random->tolerance_mm);
    worst_within += off_surface > 0.4 * random->tolerance_mm;

    const TriangleTree tree(result.mesh);
    double off_facets = 0.0;
    const auto& pieces = toothing.profile->pieces();
    for (int i = 0; i < 1000; ++i) {
      const auto piece = static_cast<std::size_t>(numbers.between(0.0, 1.0) * static_cast<double>(pieces.size()));
      const Curve& curve = pieces[piece].curve;
      const auto p = surface_point(
          toothing, {static_cast<int>(numbers.between(0.0, toothing.profile->gear().teeth)),
                     numbers.chance(0.5) ? 1 : -1, piece, numbers.between(curve.begin, curve.end)},
          numbers.between(0.0, toothing.twist.face_width_mm));
      off_facets = std::max(off_facets, tree.nearest(Point3(p.data())).distance_mm);
    }
    EXPECT_LE(off_facets, random->tolerance_mm);

    const Accuracy accuracy = measure_accuracy(result.mesh, random->part);
    EXPECT_LE(accuracy.largest_mm(), random->tolerance_mm * 1.02);
    EXPECT_GE(accuracy.facets_to_surface_mm, off_surface * 0.94 - 1e-7);
  }
  EXPECT_GT(worst_within, made / 2);  // no finer than asked for
}
INSTANTIATE_TEST_SUITE_P(PlainDeviatedDisplacedChamferedAll, RandomToothings,
                         testing::Range<std::size_t>(0, kKinds.size()));

TEST(ToothingGrid, KeepsTheToleranceWhereTheInvoluteStartsOnTheBaseCircle) {
  // There the way along the flank grows with the square of the roll angle: the middle of an edge's
  // parameters is far from its chord's. With an end relief the edges are the diagonals.
  GearboxDesign design = test::unshifted("gear", "", {12});
  design.module_mm = 1.5;
  design.gears[0].shift = 0.2333;
  design.gears[0].face_width_mm = 5.163;
  design.gears[0].modifications = {.end_relief_um = 6.37, .end_relief_length_mm = 1.536};
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  for (const double tolerance_mm : {1.0e-3, 1.5e-3, 2.0e-3, 3.0e-3}) {
    const PartMesh result = part_mesh(shapes->parts[0], {.tolerance_mm = tolerance_mm});
    EXPECT_LE(measure_accuracy(result.mesh, shapes->parts[0]).largest_mm(), tolerance_mm);
  }
}

TEST(ToothingGrid, LandsOfSharpRootsGoWithTheFlanks) {
  GearboxDesign design = test::unshifted("gear", "", {60});
  design.rack.root_radius = 0.0;
  design.gears[0].kind = GearKind::kInternal;
  design.gears[0].face_width_mm = 8.0;
  design.gears[0].modifications = {.crowning_um = 10.0, .edge_chamfer_mm = 0.1};
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  const PartMesh result = part_mesh(shapes->parts[0], {.tolerance_mm = 1e-3});
  EXPECT_TRUE(mesh_validity(result.mesh).valid());
  EXPECT_LE(measure_accuracy(result.mesh, shapes->parts[0]).largest_mm(), 1e-3);
  const auto solid = brep_of(shapes->parts[0]);
  EXPECT_TRUE(solid) << solid.error().message;
}

TEST(FlankStrips, CoverTheirPatchOnceWithNodesOfTheBorderAlone) {
  for (const bool falling : {true, false})
    for (int columns = 1; columns < 7; ++columns)
      for (int rows = 1; rows < 7; ++rows) {
        const auto facets = strips(columns, rows, falling, 1.0, 0.9);
        EXPECT_EQ(facets.size(), static_cast<std::size_t>(2 * (columns + rows) - 2));
        int twice_area = 0;
        for (const auto& [a, b, c] : facets) {
          const int area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
          EXPECT_GT(area, 0);
          twice_area += area;
          for (const PatchNode& node : {a, b, c})
            EXPECT_TRUE(node[0] == 0 || node[0] == columns || node[1] == 0 || node[1] == rows);
        }
        EXPECT_EQ(twice_area, 2 * columns * rows);
      }
}

TEST(FlankStrips, SaveAThirdOfThePlainFlanksFacetsAndNoneOfTheModifiedOnes) {
  GearboxDesign design = test::unshifted("gear", "", {17});
  design.helix_angle_rad = rad_from_deg(20.0);
  auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto facets = [&] {
    const auto shapes = part_shapes(*train);
    return static_cast<double>(part_mesh(shapes->parts[0]).mesh.triangles.size());
  };
  const double plain = facets();
  train->gears[0].deviation.deviation_mm = [](int, Flank, double, double) { return 0.0; };
  EXPECT_LT(plain, 0.75 * facets());
}

}  // namespace
}  // namespace trueflank
