// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_validity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trueflank {
namespace {

TriangleMesh tetrahedron(double x = 0.0) {
  return {.vertices = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST(MeshValidity, TetrahedronIsValidAndHasOneSixthOfTheCube) {
  const MeshValidity validity = mesh_validity(tetrahedron());
  EXPECT_TRUE(validity.valid());
  EXPECT_DOUBLE_EQ(validity.volume_mm3, 1.0 / 6.0);
  EXPECT_EQ(validity.components, 1U);
  EXPECT_NEAR(validity.smallest_altitude_mm, 0.7071067811865476, 1e-15);  // 1 / sqrt 2: three faces
}

TEST(MeshValidity, MissingTriangleLeavesThreeOpenEdges) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  EXPECT_EQ(mesh_validity(mesh).open_edges, 3U);
  EXPECT_FALSE(mesh_validity(mesh).valid());
}

TEST(MeshValidity, TurnedTriangleIsMisoriented) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  EXPECT_GT(mesh_validity(mesh).misoriented_edges, 0U);
  EXPECT_FALSE(mesh_validity(mesh).valid());
}

TEST(MeshValidity, InsideOutHasNegativeVolume) {
  TriangleMesh mesh = tetrahedron();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_LT(mesh_validity(mesh).volume_mm3, 0.0);
  EXPECT_FALSE(mesh_validity(mesh).valid());
}

TEST(MeshValidity, TwoBodiesThatShareAVertexAreNotManifold) {
  TriangleMesh mesh = tetrahedron();
  for (auto t : tetrahedron().triangles) {
    for (auto& v : t)
      if (v != 0) v += 3;
    std::swap(t[0], t[1]);
    mesh.triangles.push_back(t);
  }
  for (auto v : {std::array<double, 3>{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}) mesh.vertices.push_back(v);
  const MeshValidity validity = mesh_validity(mesh);
  EXPECT_EQ(validity.open_edges, 0U);
  EXPECT_EQ(validity.non_manifold_vertices, 1U);
  EXPECT_FALSE(validity.valid());
}

TEST(MeshValidity, CountsBodiesAndUnusedVertices) {
  TriangleMesh mesh = tetrahedron();
  const TriangleMesh other = tetrahedron(5.0);
  for (auto t : other.triangles) {
    for (auto& v : t) v += 4;
    mesh.triangles.push_back(t);
  }
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  mesh.vertices.push_back({9, 9, 9});
  EXPECT_EQ(mesh_validity(mesh).components, 2U);
  EXPECT_EQ(mesh_validity(mesh).unused_vertices, 1U);
  EXPECT_TRUE(mesh_validity(mesh).valid());
}

TEST(MeshValidity, TriangleWithoutAreaIsDegenerate) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[3] = {0.5, 0.0, 0.0};  // onto the edge of vertices 0 and 1
  EXPECT_GT(mesh_validity(mesh).degenerate_triangles, 0U);
  EXPECT_EQ(mesh_validity(mesh).smallest_altitude_mm, 0.0);
}

TEST(MeshValidity, WrongIndicesAndCoordinatesAreToldNotFollowed) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles[0][0] = 17;
  EXPECT_FALSE(mesh_validity(mesh).indices_in_range);
  mesh = tetrahedron();
  mesh.vertices[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(mesh_validity(mesh).coordinates_finite);
  EXPECT_FALSE(mesh_validity(mesh).valid());
}

TEST(MeshValidity, OneFacetManyTimesIsJudgedAtOnce) {
  TriangleMesh mesh = tetrahedron();
  for (int i = 0; i < 300'000; ++i) mesh.triangles.push_back(mesh.triangles.front());
  const MeshValidity validity = mesh_validity(mesh);  // once a square of the count
  EXPECT_GE(validity.misoriented_edges, 900'003U);
  EXPECT_FALSE(validity.valid());
}

TEST(MeshValidity, AFanOfManyFacetsIsJudgedAtOnce) {
  constexpr std::uint32_t kRim = 200'000;
  TriangleMesh mesh{.vertices = {{0, 0, -1}, {0, 0, 1}}, .triangles = {}};
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / kRim;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0.0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kRim;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a, b});
  }
  EXPECT_TRUE(mesh_validity(mesh).valid());
}

}  // namespace
}  // namespace trueflank
