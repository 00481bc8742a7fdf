// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_accuracy.h"

#include <gtest/gtest.h>

#include "tests/solid/random_part.h"
#include "tests/train/prototype_design.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {
namespace {

class MeshAccuracy : public testing::Test {
 protected:
  void SetUp() override {
    train_ = std::make_unique<GearTrain>(*lay_out(test::bored_prototype()));
    shapes_ = *part_shapes(*train_);
  }
  [[nodiscard]] const PartShape& part(std::size_t i) const { return shapes_.parts[i]; }

  std::unique_ptr<GearTrain> train_;
  PartShapes shapes_;
};

TEST_F(MeshAccuracy, FindsTheChordErrorThatTheMesherPromises) {
  for (const PartShape& shape : shapes_.parts)
    for (double tolerance : {2e-2, 1e-3, 1e-4}) {
      const PartMesh made = part_mesh(shape, {.tolerance_mm = tolerance});
      const Accuracy found = measure_accuracy(made.mesh, shape);
      EXPECT_LE(found.largest_mm(), made.chord_error_mm * (1.0 + 1e-6)) << shape.name;
      EXPECT_GE(found.facets_to_surface_mm, 0.98 * made.chord_error_mm) << shape.name;
      EXPECT_GE(found.surface_to_facets_mm, 0.98 * made.chord_error_mm) << shape.name;
    }
}

TEST_F(MeshAccuracy, RandomPartsKeepTheirPromiseBothWays) {
  for (std::uint64_t seed = 3000; seed < 3100; ++seed) {
    const auto random = test::random_part(seed);
    if (!random) continue;
    SCOPED_TRACE(random->text);
    const PartMesh made = part_mesh(random->part, {.tolerance_mm = random->tolerance_mm});
    const Accuracy found = measure_accuracy(made.mesh, random->part);
    EXPECT_LE(found.facets_to_surface_mm, made.chord_error_mm * (1.0 + 1e-5) + 1e-8);
    EXPECT_LE(found.surface_to_facets_mm, made.chord_error_mm * (1.0 + 1e-5) + 1e-8);
    EXPECT_GE(found.largest_mm(), 0.5 * made.chord_error_mm);  // the bound counts skipped pieces whole
  }
}

TEST_F(MeshAccuracy, VertexThatStandsOutIsFoundWithItsPlaceAndSign) {
  TriangleMesh mesh = part_mesh(part(0)).mesh;
  std::array<double, 3>* tip = &mesh.vertices[0];
  for (auto& v : mesh.vertices)
    if (std::hypot(v[0], v[1]) > std::hypot((*tip)[0], (*tip)[1]) + 1e-9) tip = &v;
  const double radius = std::hypot((*tip)[0], (*tip)[1]);
  for (std::size_t i = 0; i < 2; ++i) (*tip)[i] *= (radius + 0.03) / radius;
  const std::array<double, 3> place = *tip;
  const Accuracy found = measure_accuracy(mesh, part(0));
  EXPECT_NEAR(found.facets_to_surface_mm, 0.03, 1e-6);
  EXPECT_NEAR(found.most_excess_mm, 0.03, 1e-6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.worst_place_mm[i], place[i], 1e-9);
}

TEST_F(MeshAccuracy, MissingBoltHoleIsFound) {
  PartShape without = part(2);
  without.slabs[0].holes.pop_back();
  const Accuracy found = measure_accuracy(part_mesh(without).mesh, part(2));
  EXPECT_LT(found.facets_to_surface_mm, 1.001e-3);  // what is there is right
  EXPECT_GT(found.surface_to_facets_mm, 1.0);
}

TEST_F(MeshAccuracy, HoleTooManyIsFound) {
  PartShape without = part(2);
  without.slabs[0].holes.pop_back();
  EXPECT_GT(measure_accuracy(part_mesh(part(2)).mesh, without).facets_to_surface_mm, 1.0);
}

TEST_F(MeshAccuracy, MissingToothIsFound) {
  // the wall of tooth 1 cut short: its points pulled to the root circle
  TriangleMesh mesh = part_mesh(part(0)).mesh;
  const double root = train_->gears[0].profile.root_radius_mm();
  for (auto& v : mesh.vertices) {
    const double r = std::hypot(v[0], v[1]);
    if (r > root && std::abs(std::atan2(v[1], v[0])) < kPi / 12.0)
      for (std::size_t i = 0; i < 2; ++i) v[i] *= root / r;
  }
  EXPECT_GT(measure_accuracy(mesh, part(0)).surface_to_facets_mm, 0.5);
}

TEST_F(MeshAccuracy, PlanetTurnedAgainstItsOtherLayerIsFound) {
  PartShape turned = part(1);
  std::get<ToothedOutline>(turned.slabs[2].outer).rotation_rad += 1e-3;
  const Accuracy found = measure_accuracy(part_mesh(turned).mesh, part(1));
  const double radius = train_->find("planet2")->profile.tip_radius_mm();
  EXPECT_GT(found.facets_to_surface_mm, 0.9e-3 * radius * 0.8);
  EXPECT_LT(found.facets_to_surface_mm, 1.1e-3 * radius);
}

TEST_F(MeshAccuracy, PartTooHighAndPartTooLowAreFound) {
  for (double change : {-0.01, 0.01}) {
    TriangleMesh mesh = part_mesh(part(0)).mesh;
    for (auto& v : mesh.vertices)
      if (v[2] > 0.0) v[2] += change;
    EXPECT_NEAR(measure_accuracy(mesh, part(0)).facets_to_surface_mm, 0.01, 2e-4);
  }
}

TEST_F(MeshAccuracy, UnsharedRoundedVerticesAddOnlyTheirRounding) {
  const TriangleMesh mesh = part_mesh(part(1)).mesh;
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (std::uint32_t v : t) {
      auto p = mesh.vertices[v];
      for (double& x : p) x = static_cast<double>(static_cast<float>(x));
      soup.vertices.push_back(p);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const double exact = measure_accuracy(mesh, part(1)).largest_mm();
  EXPECT_NEAR(measure_accuracy(soup, part(1)).largest_mm(), exact, 3e-6);
}

TEST_F(MeshAccuracy, EmptyMeshIsInfinitelyFar) {
  EXPECT_EQ(measure_accuracy(TriangleMesh{}, part(0)).surface_to_facets_mm,
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace trueflank
