// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/toothing_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/solid/random_toothing.h"
#include "tests/support/sample_gears.h"
#include "tests/train/prototype_design.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/measure/triangle_tree.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/screw_net.h"

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

TEST(ScrewNet, CoversItsPatchOnceAndDevelopablePartsWithNodesOfTheirBorderAlone) {
  for (const double turn : {0.3, -0.3})
    for (const double edge_turn : {0.1, -0.1})
      for (int bent = 1; bent < 5; ++bent)
        for (int columns = 1; columns < 6; ++columns) {
          std::vector<NetEdge> edges;
          for (int i = 0; i < bent; ++i)
            edges.push_back({.region = 0, .length_mm = 0.1, .turn_rad = -edge_turn, .support_mm = 3.0});
          for (int i = 0; i < columns; ++i)
            edges.push_back({.region = 1, .developable = true, .length_mm = 0.3, .turn_rad = edge_turn,
                             .support_mm = 3.0, .support_from_mm = 3.0, .support_to_mm = 3.0});
          std::vector<std::vector<double>> inner(edges.size());
          for (int i = 0; i <= bent; ++i)
            for (int k = 1; k <= i; ++k) inner[static_cast<std::size_t>(i) % edges.size()].push_back(k / (i + 1.0));
          std::size_t vertices = 2 * edges.size() + 2;  // an open patch: the next tooth's first column, too
          const NetPatch net = net_patch(edges, inner, turn);
          double area = 0.0;
          for (std::size_t t = 0; t < net.facets.size(); ++t) {
            std::array<Point2, 3> c;
            for (std::size_t k = 0; k < 3; ++k) {
              const NetNode& node = net.facets[t][k];
              const auto& rows = net.inner[static_cast<std::size_t>(node.column) % edges.size()];
              const auto row = static_cast<std::size_t>(node.row);
              ASSERT_LE(row, rows.size() + 1);
              c[k] = {node.column, row == 0 ? 0.0 : row > rows.size() ? 1.0 : rows[row - 1]};
            }
            const double twice = cross(c[1] - c[0], c[2] - c[0]);
            EXPECT_GT(twice, 0.0);
            area += 0.5 * twice;
          }
          EXPECT_NEAR(area, static_cast<double>(edges.size()), 1e-12);
          for (const auto& rows : inner) vertices += rows.size();
          const std::size_t first = inner[0].size(), border = 2 * edges.size() + 2 * (first + 1);
          // by Euler, with the first column's inner vertices on both sides
          EXPECT_EQ(net.facets.size(), 2 * (vertices + first) - border - 2);
        }
}

/// Facets that no mesh of a plain twisted toothing with vertices on its surface can do without, of one
/// tooth: docs/theory/helical-facets.md.
double least_facets(const Toothing& toothing, double tolerance_mm) {
  constexpr int kSteps = 400;
  const ToothProfile& profile = *toothing.profile;
  const double omega = std::abs(toothing.twist.turn_rad_per_mm), width = toothing.twist.face_width_mm;
  const double turn = omega * width, room = 8.0 * tolerance_mm;
  const auto chords = [&](double share) { return std::max(1.0, std::ceil(share - 1e-3)); };
  double facets = 0.0;
  for (const ProfilePiece& piece : profile.pieces()) {
    const bool land = piece.kind == PieceKind::kTip || piece.kind == PieceKind::kRoot;
    double across = 0.0, bent = 0.0, support_begin = 0.0, support_end = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const auto parameter = [&](double k) { return std::lerp(piece.curve.begin, piece.curve.end, k / kSteps); };
      const Point2 a = point_at(piece.curve, parameter(i)), b = point_at(piece.curve, parameter(i + 1));
      const Point2 p = point_at(piece.curve, parameter(i + 0.5));
      const Point2 ta = tangent_at(piece.curve, parameter(i + 1e-3)), tb = tangent_at(piece.curve, parameter(i + 1 - 1e-3));
      const double length = (b - a).norm();
      if (!(length > 0.0)) continue;
      const Point2 t = (b - a) / length;
      const double curvature = std::asin(std::clamp(cross(ta, tb), -1.0, 1.0)) / length;
      const double support = p.dot(Point2(t.y(), -t.x()));
      const double cosine = 1.0 / std::hypot(1.0, omega * p.dot(t));
      if (i == 0) support_begin = std::abs(support) * cosine;
      support_end = std::abs(support) * cosine;
      across += length * std::sqrt(std::abs(curvature) * cosine / room);
      const double gauss = curvature * support - 1.0;
      bent += length * turn * std::sqrt(std::abs(gauss)) * cosine / ((gauss > 0.0 ? 2.598 : 4.473) * tolerance_mm);
    }
    const auto along = [&](double support) { return chords(turn * std::sqrt(support / room)); };
    if (land) {  // half of it
      facets += 2.0 * chords(2.0 * across) + 2.0 * along(support_begin) - 2.0;
    } else if (piece.kind == PieceKind::kInvolute) {
      facets += 2.0 * (2.0 * chords(across) + along(support_begin) + along(support_end) - 2.0);
    } else {
      facets += 2.0 * std::max(bent, 2.0 * chords(across) + along(support_begin) + along(support_end) - 2.0);
    }
  }
  return facets;
}

TEST(ToothingGrid, PlainTwistedTeethHaveFewFacetsMoreThanTheLeast) {
  double all = 0.0, all_least = 0.0;
  int made = 0;
  for (std::uint64_t seed = 0; made < 40; ++seed) {
    auto random = test::random_toothing(seed);
    if (!random || random->outline().twist.herringbone) continue;
    if (made % 2 == 0) random->tolerance_mm *= 0.2;  // with many facets the whole numbers matter less
    SCOPED_TRACE(random->text);
    const Toothing toothing = random->outline().toothing();
    const double tolerance = meshing_tolerance_mm(random->part, random->tolerance_mm);
    const ToothingGrid grid(random->outline(), {0.0, toothing.twist.face_width_mm}, tolerance);
    const std::size_t facets = grid.patches().empty()
                                   ? 2 * (grid.heights_mm().size() - 1) * static_cast<std::size_t>(grid.points_per_tooth())
                                   : grid.patches()[0].facets.size();
    const double least = least_facets(toothing, tolerance);
    // whole chords where there are few, and undercut teeth, whose fillets bend both ways at a slant
    EXPECT_LT(static_cast<double>(facets), 1.8 * least);
    all += static_cast<double>(facets);
    all_least += least;
    ++made;
  }
  EXPECT_LT(all, 1.3 * all_least);
}

}  // namespace
}  // namespace trueflank
