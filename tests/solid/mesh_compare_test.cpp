// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

#include "tests/solid/random_part.h"
#include "tests/train/prototype_design.h"
#include "trueflank/solid/measure/triangle_tree.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {
namespace {

/// A box [0, size] cut into a grid of squares on each side, the diagonals one way or the other.
TriangleMesh box(double size_x, double size_y, double size_z, int cells, bool other_diagonal) {
  TriangleMesh mesh;
  const auto side = [&](const Point3& corner, const Point3& u, const Point3& v) {
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (auto [a, b] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
          const Point3 p = corner + u * (1.0 * a / cells) + v * (1.0 * b / cells);
          mesh.vertices.push_back({p.x(), p.y(), p.z()});
        }
        if (other_diagonal) {
          mesh.triangles.push_back({first, first + 1, first + 3});
          mesh.triangles.push_back({first + 1, first + 2, first + 3});
        } else {
          mesh.triangles.push_back({first, first + 1, first + 2});
          mesh.triangles.push_back({first, first + 2, first + 3});
        }
      }
  };
  const Point3 x(size_x, 0, 0), y(0, size_y, 0), z(0, 0, size_z), o(0, 0, 0);
  side(o, y, x);
  side(z, x, y);
  side(o, x, z);
  side(y, z, x);
  side(o, z, y);
  side(x, y, z);
  return mesh;
}

TEST(MeshCompare, BoxesOfDifferentTessellationAreTheSame) {
  const MeshComparison c = compare_meshes(box(10, 10, 10, 1, false), box(10, 10, 10, 7, true));
  EXPECT_TRUE(c.same);
  EXPECT_LT(c.from_golden.bound_mm, 1e-12 + 1e-3);
  EXPECT_LT(c.from_golden.largest_mm, 1e-12);
  EXPECT_LT(c.from_new.largest_mm, 1e-12);
  EXPECT_NEAR(c.golden.volume_mm3, 1000.0, 1e-9);
  EXPECT_NEAR(c.made.area_mm2, 600.0, 1e-9);
  EXPECT_EQ(c.made.upper_mm, (std::array<double, 3>{10, 10, 10}));
}

TEST(MeshCompare, HigherBoxIsAsFarAsItIsHigher) {
  const MeshComparison c = compare_meshes(box(10, 10, 10, 3, false), box(10, 10, 10.25, 4, true));
  EXPECT_FALSE(c.same);
  EXPECT_NEAR(c.from_new.largest_mm, 0.25, 1e-12);
  EXPECT_LE(c.from_new.bound_mm, 0.2525);
  EXPECT_NEAR(c.from_new.worst_place_mm[2], 10.25, 1e-12);
  EXPECT_NEAR(c.from_golden.largest_mm, 0.25, 1e-12);
  // rms: the top is 0.25 off, the four sides' new strips 0 ... 0.25
  const double expected = std::sqrt((100 * 0.0625 + 4 * 10 * 0.25 * 0.0625 / 3) / (200 + 4 * 102.5));
  EXPECT_NEAR(c.from_new.rms_mm, expected, 0.03 * expected);  // a piece counts by its middle
}

TEST(MeshCompare, DentInTheMiddleOfALargeFaceIsFound) {
  // no vertex of the golden mesh is near it, and its own vertices are few: a pit 0.1 mm deep and wide
  TriangleMesh pitted = box(10, 10, 10, 1, false);
  std::erase_if(pitted.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](auto v) { return pitted.vertices[v][2] == 10.0; });
  });
  const auto add = [&](double x, double y, double z) {
    pitted.vertices.push_back({x, y, z});
    return static_cast<std::uint32_t>(pitted.vertices.size() - 1);
  };
  const std::uint32_t corner[] = {add(0, 0, 10), add(10, 0, 10), add(10, 10, 10), add(0, 10, 10)};
  const std::uint32_t rim[] = {add(6, 6, 10), add(6.1, 6, 10), add(6.1, 6.1, 10), add(6, 6.1, 10)};
  const std::uint32_t pit = add(6.05, 6.05, 9.9);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    pitted.triangles.push_back({corner[i], corner[j], rim[j]});
    pitted.triangles.push_back({corner[i], rim[j], rim[i]});
    pitted.triangles.push_back({rim[i], rim[j], pit});
  }
  const MeshComparison c = compare_meshes(box(10, 10, 10, 2, true), pitted, {.tolerance_mm = 0.02});
  EXPECT_FALSE(c.same);
  EXPECT_NEAR(c.from_new.largest_mm, 0.1, 1e-9);
  // from the flat side the middle of the pit is nearest to its walls: inclined by atan(0.1 / 0.05)
  EXPECT_NEAR(c.from_golden.largest_mm, 0.05 * std::sin(std::atan(2.0)), 1e-3);
  EXPECT_NEAR(c.from_golden.worst_place_mm[0], 6.05, 0.01);
  EXPECT_NEAR(c.from_golden.worst_place_mm[1], 6.05, 0.01);
}

class MeshCompareParts : public testing::Test {
 protected:
  void SetUp() override {
    train_ = std::make_unique<GearTrain>(*lay_out(test::bored_prototype()));
    shapes_ = *part_shapes(*train_);
  }
  [[nodiscard]] TriangleMesh mesh(std::size_t part, double tolerance_mm) const {
    return part_mesh(shapes_.parts[part], {.tolerance_mm = tolerance_mm}).mesh;
  }
  std::unique_ptr<GearTrain> train_;
  PartShapes shapes_;
};

TEST_F(MeshCompareParts, ToleranceOfTheTessellationIsTheDistance) {
  const MeshComparison c = compare_meshes(mesh(0, 1e-5), mesh(0, 1e-3), {.tolerance_mm = 1e-4});
  EXPECT_FALSE(c.same);
  EXPECT_GT(c.largest_mm(), 0.95e-3);
  EXPECT_LT(c.from_golden.bound_mm, 1.02e-3);
  EXPECT_LT(c.from_new.bound_mm, 1.02e-3);
  EXPECT_TRUE(compare_meshes(mesh(0, 1e-5), mesh(0, 1e-3), {.tolerance_mm = 1.02e-3}).same);
}

TEST_F(MeshCompareParts, ShiftIsMeasuredExactlyWhateverTheTessellation) {
  TriangleMesh moved = mesh(1, 0.8e-3);
  for (auto& v : moved.vertices) v[2] += 0.05;
  const MeshComparison c = compare_meshes(mesh(1, 1e-3), moved, {.tolerance_mm = 1e-3});
  EXPECT_FALSE(c.same);
  // up to a chord height aside at the rim: sqrt(50^2 + 1^2) um
  EXPECT_NEAR(c.from_golden.largest_mm, 0.05, 1.1e-5);
  EXPECT_NEAR(c.from_new.largest_mm, 0.05, 1.1e-5);
  EXPECT_LE(c.from_new.bound_mm, 0.0506);
}

TEST_F(MeshCompareParts, MissingBoltHoleIsFoundFromBothSides) {
  PartShape without = shapes_.parts[2];
  without.slabs[0].holes.pop_back();
  const MeshComparison c = compare_meshes(mesh(2, 1e-3), part_mesh(without).mesh);
  EXPECT_FALSE(c.same);
  EXPECT_NEAR(c.from_new.largest_mm, 1.6, 0.02);  // the middle of the hole's cover to its rim
  EXPECT_GT(c.from_golden.largest_mm, 1.6);       // half way down the hole to the next surface
}

TEST_F(MeshCompareParts, SwappingTheMeshesSwapsTheResult) {
  const TriangleMesh a = mesh(0, 1e-3), b = mesh(0, 1e-2);
  const MeshComparison c = compare_meshes(a, b), d = compare_meshes(b, a);
  EXPECT_EQ(c.from_golden.largest_mm, d.from_new.largest_mm);
  EXPECT_EQ(c.from_new.bound_mm, d.from_golden.bound_mm);
  EXPECT_EQ(c.worst_is_on_golden(), !d.worst_is_on_golden());
}

TEST_F(MeshCompareParts, RoundedCopyIsAsFarAsItsFarthestCornerOrMiddle) {
  const TriangleMesh golden = mesh(0, 1e-2);
  TriangleMesh rounded = golden;
  for (auto& v : rounded.vertices)
    for (double& c : v) c = static_cast<float>(c);
  const MeshComparison c = compare_meshes(golden, rounded);
  const TriangleTree tree(golden);
  double farthest_mm = 0.0;
  const auto look = [&](const Point3& p) {
    farthest_mm = std::max(farthest_mm, tree.nearest(p).distance_mm);
  };
  for (const auto& t : rounded.triangles) {
    const Point3 p0(rounded.vertices[t[0]].data()), p1(rounded.vertices[t[1]].data()),
        p2(rounded.vertices[t[2]].data());
    for (const Point3& p : {p0, p1, p2, Point3((p0 + p1 + p2) / 3.0)}) look(p);
  }
  EXPECT_GT(farthest_mm, 0.0);
  EXPECT_NEAR(c.from_new.largest_mm, farthest_mm, 1e-9 * farthest_mm);
  EXPECT_LE(c.from_new.rms_mm, farthest_mm);
  EXPECT_TRUE(c.same);
}

TEST_F(MeshCompareParts, RoundingOfHugeCoordinatesIsNoDistance) {
  TriangleMesh huge = mesh(0, 1e-2);
  for (auto& v : huge.vertices)
    for (double& c : v) c *= 1e20;
  TriangleMesh turned = huge;
  std::reverse(turned.triangles.begin(), turned.triangles.end());
  const MeshComparison c = compare_meshes(huge, turned);
  EXPECT_TRUE(c.from_golden.exact && c.from_new.exact);
  EXPECT_LT(c.largest_mm(), 1e20 * 1e-12);
  EXPECT_LT(c.from_new.bound_mm, 1e20 * 1e-12);
}

TEST_F(MeshCompareParts, EmptyMeshIsInfinitelyFar) {
  const MeshComparison c = compare_meshes(mesh(0, 1e-2), TriangleMesh{});
  EXPECT_FALSE(c.same);
  EXPECT_EQ(c.from_golden.largest_mm, std::numeric_limits<double>::infinity());
}

TEST(MeshCompare, RandomPartsBracketTheirChordErrors) {
  for (std::uint64_t seed = 5000; seed < 5024; ++seed) {
    const auto random = test::random_part(seed);
    if (!random || random->train->gears[0].profile.gear().teeth > 60) continue;
    SCOPED_TRACE(random->text);
    const double tolerance = std::max(random->tolerance_mm, 1e-3);
    const PartMesh coarse = part_mesh(random->part, {.tolerance_mm = tolerance});
    const PartMesh fine = part_mesh(random->part, {.tolerance_mm = 0.3 * tolerance});
    const MeshComparison c = compare_meshes(fine.mesh, coarse.mesh, {.tolerance_mm = 0.1 * tolerance});
    const double most = coarse.chord_error_mm + fine.chord_error_mm;
    EXPECT_LE(c.largest_mm(), most * (1.0 + 1e-6));
    EXPECT_GE(c.largest_mm(), 0.4 * coarse.chord_error_mm);
    EXPECT_LE(c.from_golden.bound_mm, 1.011 * std::max(c.from_golden.largest_mm, 0.1 * tolerance));
    EXPECT_LE(c.from_new.bound_mm, 1.011 * std::max(c.from_new.largest_mm, 0.1 * tolerance));
  }
}

TEST(TriangleTree, FindsTheNearestOfAllTriangles) {
  test::RandomNumbers random(11);
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i) {
    const Point3 centre(random.between(-9, 9), random.between(-9, 9), random.between(-9, 9));
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back({centre.x() + random.between(-1, 1), centre.y() + random.between(-1, 1),
                               centre.z() + random.between(-1, 1)});
    const auto v = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  const TriangleTree tree(mesh);
  for (int i = 0; i < 500; ++i) {
    const Point3 p(random.between(-12, 12), random.between(-12, 12), random.between(-12, 12));
    // by brute force over a fine grid of barycentric coordinates
    double nearest = 1e300;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = tree.corners(t);
      if (((c[0] + c[1] + c[2]) / 3.0 - p).norm() > nearest + 2.5) continue;
      for (int a = 0; a <= 40; ++a)
        for (int b = 0; a + b <= 40; ++b)
          nearest = std::min(nearest, (c[0] + (c[1] - c[0]) * a / 40.0 + (c[2] - c[0]) * b / 40.0 - p).norm());
    }
    const double found = tree.nearest(p, static_cast<std::uint32_t>(i % 300)).distance_mm;
    EXPECT_LE(found, nearest + 1e-12);
    EXPECT_GT(found, nearest - 0.05);
  }
}

// Boxes and planes in floats only say which facets need not be looked at: long facets that run
// aslant, copies of one facet, far from the origin and of any size.
TEST(TriangleTree, DistanceIsThatOfTheNearestOfAllTriangles) {
  test::RandomNumbers random(12);
  for (const double size : {1e-6, 1.0, 1e5})
    for (const double away : {0.0, 1e3}) {
      TriangleMesh mesh;
      for (std::uint32_t i = 0; i < 400; ++i) {
        const double x = random.between(-1, 1), y = random.between(-1, 1);
        const auto add = [&](double dx, double dy, double z) {
          mesh.vertices.push_back({size * (x + dx + away), size * (y + dy), size * z});
        };
        add(0.0, 0.0, 0.0);
        add(0.01, 0.0, 0.0);
        add(0.3, 0.3, 1.0);
        for (std::uint32_t copies = i % 40 == 0 ? 30 : 1; copies > 0; --copies)
          mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      }
      const TriangleTree tree(mesh);
      std::uint32_t hint = 0;
      for (int i = 0; i < 300; ++i) {
        const double reach = i % 3 == 0 ? 30.0 : 1.2;
        const Point3 p =
            size * Point3(random.between(-reach, reach) + away, random.between(-reach, reach),
                          random.between(-reach, reach));
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
          nearest = std::min(nearest, (nearest_on_triangle(p, tree.corners(t)) - p).norm());
        const TriangleTree::Nearest found = tree.nearest(p, hint);
        EXPECT_NEAR(found.distance_mm, nearest, 1e-12 * size * (1.0 + away));
        hint = found.triangle;
      }
    }
}

/// Processor time of a comparison of a mesh with itself.
double seconds_of_comparison(const TriangleMesh& mesh, const TriangleMesh& other, bool same) {
  const std::clock_t begin = std::clock();
  const MeshComparison comparison = compare_meshes(mesh, other, {.tolerance_mm = 1e-3});
  EXPECT_EQ(comparison.same, same);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Where facets lie in heaps boxes tell nothing: each question once went through all of them.
TEST(MeshCompare, TakesNoLongerThanTheFacetsAreMany) {
  constexpr std::uint32_t kFacets = 40'000;
  constexpr double kMost_s = 8.0;  // both ways, on a slow machine; of all pairs: minutes
  TriangleMesh equal{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  equal.triangles.assign(kFacets, {0, 1, 2});
  TriangleMesh raised = equal;
  for (auto& v : raised.vertices) v[2] = 0.5;
  EXPECT_LT(seconds_of_comparison(equal, equal, true), kMost_s);
  EXPECT_LT(seconds_of_comparison(equal, raised, false), kMost_s);
  TriangleMesh heap, needles{{{0, 0, 0}}, {}};
  std::minstd_rand random(3);
  std::uniform_real_distribution<double> shift(-1e-6, 1e-6);
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    for (const auto& v : equal.vertices)
      heap.vertices.push_back({v[0] + shift(random), v[1] + shift(random), v[2] + shift(random)});
    heap.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    const double angle = 2.0 * kPi * i / kFacets;
    needles.vertices.push_back({std::cos(angle), std::sin(angle), 0.0});
    needles.triangles.push_back({0, i + 1, i + 2 > kFacets ? 1 : i + 2});
  }
  EXPECT_LT(seconds_of_comparison(heap, heap, true), kMost_s);
  EXPECT_LT(seconds_of_comparison(heap, equal, true), kMost_s);
  EXPECT_LT(seconds_of_comparison(needles, needles, true), kMost_s);
}

}  // namespace
}  // namespace trueflank
