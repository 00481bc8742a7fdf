// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/facet_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/export/sample_scene.h"

namespace trueflank::io {
namespace {

using test::SampleScene;

std::vector<Facet> facets_of(const Scene& scene) {
  std::vector<Facet> facets;
  for (const Placement& body : scene.bodies) {
    const TriangleMesh mesh = placed_mesh(*scene.shapes[body.part].mesh, body);
    for (const auto& t : mesh.triangles)
      facets.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  return facets;
}

FacetComparison compared(const Scene& scene, const std::vector<Facet>& facets) {
  FacetComparison comparison(scene);
  for (const Facet& facet : facets) comparison.take(facet);
  return comparison;
}

TEST(FacetComparison, TellsHowFarACornerMovedAndTheVolume) {
  const SampleScene sample;
  const Scene scene = sample.assembly();
  std::vector<Facet> facets = facets_of(scene);
  double volume_mm3 = 0.0;
  for (const Placement& body : scene.bodies)
    volume_mm3 += test::summed_volume_mm3(*scene.shapes[body.part].mesh);
  facets[facets.size() - 1][2][1] += 3e-7;
  FacetComparison comparison = compared(scene, facets);
  ASSERT_TRUE(comparison.rounding_mm());
  EXPECT_NEAR(*comparison.rounding_mm(), 3e-7, 1e-13);
  EXPECT_EQ(comparison.facets(), facets.size());
  EXPECT_NEAR(comparison.volume_mm3(), volume_mm3, 1e-4);
}

TEST(FacetComparison, RefusesMovedMissingAndAddedFacets) {
  const SampleScene sample;
  const Scene scene = sample.assembly();
  const std::vector<Facet> facets = facets_of(scene);
  EXPECT_TRUE(compared(scene, facets).rounding_mm());
  for (const std::size_t at : {std::size_t{0}, facets.size() / 2, facets.size() - 1}) {
    auto moved = facets, missing = facets, added = facets, turned = facets;
    moved[at][1][2] += 1e-3;
    EXPECT_FALSE(compared(scene, moved).rounding_mm()) << at;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_FALSE(compared(scene, missing).rounding_mm()) << at;
    added.insert(added.begin() + static_cast<std::ptrdiff_t>(at), facets[at]);
    EXPECT_FALSE(compared(scene, added).rounding_mm()) << at;
    std::swap(turned[at][0], turned[at][1]);
    EXPECT_FALSE(compared(scene, turned).rounding_mm()) << at;
  }
  EXPECT_FALSE(compared(scene, {}).rounding_mm());
}

TEST(FacetComparison, OnlyAFacetThatCollapsedMayBeMissing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {40, 0, 0}, {40, 1e-8, 0}, {0, 9, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Scene scene = part_scene("", "sliver", mesh);
  const std::vector<Facet> all = facets_of(scene);
  EXPECT_TRUE(compared(scene, all).rounding_mm());
  EXPECT_TRUE(compared(scene, {all[1]}).rounding_mm());
  EXPECT_FALSE(compared(scene, {all[0]}).rounding_mm());
}

}  // namespace
}  // namespace trueflank::io
