// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"

namespace trueflank {
namespace {

ToothProfile profile_of(const Gear& gear) {
  auto profile = ToothProfile::make(gear);
  EXPECT_TRUE(profile);
  return *profile;
}

TEST(Brep, EverySampleGearIsClosed) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const ToothProfile profile = profile_of(gear);
    const PartShape part = gear.kind == GearKind::kExternal ? test::gear_part(name, profile, 7.5)
                                                            : test::ring_part(name, profile, 7.5);
    const auto brep = brep_of(part);
    ASSERT_TRUE(brep) << name;
    EXPECT_TRUE(is_closed(*brep)) << name;
    EXPECT_LE(brep->fit_error_mm, 1e-7) << name;
  }
}

TEST(Brep, ALostFaceATurnedEdgeOrABrokenLoopIsNotClosed) {
  const ToothProfile profile = profile_of(test::external_gear(12, 0.3));
  const auto brep = brep_of(test::gear_part("gear", profile, 5.0));
  ASSERT_TRUE(brep);
  Brep lost = *brep;
  lost.faces.pop_back();
  EXPECT_FALSE(is_closed(lost));
  Brep turned = *brep;
  turned.faces[3].loops[0][0].forward = !turned.faces[3].loops[0][0].forward;
  EXPECT_FALSE(is_closed(turned));
  Brep broken = *brep;
  std::swap(broken.faces[3].loops[0][0], broken.faces[3].loops[0][1]);
  EXPECT_FALSE(is_closed(broken));
}

TEST(Brep, SplinesStartAndEndInTheVerticesOfTheirEdges) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const ToothProfile profile = profile_of(gear);
    const auto brep = brep_of(gear.kind == GearKind::kExternal
                                  ? test::gear_part(name, profile, 7.5)
                                  : test::ring_part(name, profile, 7.5));
    ASSERT_TRUE(brep) << name;
    for (const BrepEdge& edge : brep->edges)
      if (const auto* s = std::get_if<SplineCurve>(&brep->curves[edge.curve])) {
        EXPECT_EQ(s->poles.front(), brep->vertices[edge.start]);
        EXPECT_EQ(s->poles.back(), brep->vertices[edge.end]);
      }
  }
}

TEST(Brep, VerticesOfArcsLieOnTheirCircles) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const ToothProfile profile = profile_of(gear);
    const PartShape part = gear.kind == GearKind::kExternal ? test::gear_part(name, profile, 7.5)
                                                            : test::ring_part(name, profile, 7.5);
    const auto brep = brep_of(part);
    ASSERT_TRUE(brep) << name;
    for (const BrepEdge& edge : brep->edges)
      if (const auto* c = std::get_if<CircleCurve>(&brep->curves[edge.curve]))
        for (const int vertex : {edge.start, edge.end}) {
          const double distance_mm = (brep->vertices[vertex] - c->frame.origin).norm();
          EXPECT_NEAR(distance_mm, c->radius_mm, 1e-9) << name;
        }
  }
}

TEST(Brep, AWallThroughSeveralSlabsIsOneFace) {
  const ToothProfile profile = profile_of(test::external_gear(32, 0.4));
  const BoreOutline bore{{.diameter_mm = 8.0}};
  const ToothedOutline teeth{&profile, 0.0};
  const PartShape whole = test::gear_part("gear", profile, 8.0, {bore});
  const PartShape cut{"gear", {Slab{0.0, 3.0, teeth, {bore}}, Slab{3.0, 8.0, teeth, {bore}}}};
  const auto a = brep_of(whole), b = brep_of(cut);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->faces.size(), b->faces.size());
  EXPECT_EQ(a->edges.size(), b->edges.size());
}

TEST(Brep, StepFacesLookTheWayTheirMaterialEnds) {
  const ToothProfile lower = profile_of(test::external_gear(39, 0.3));
  const ToothProfile upper = profile_of(test::external_gear(32, 0.4));
  const auto brep = brep_of(test::planet_part(lower, upper));
  ASSERT_TRUE(brep);
  EXPECT_TRUE(is_closed(*brep));
  std::vector<std::pair<double, double>> found;  // height, direction of the normal
  for (const BrepFace& face : brep->faces)
    if (const auto* plane = std::get_if<PlaneSurface>(&brep->surfaces[face.surface]))
      found.emplace_back(plane->frame.origin.z(), plane->frame.axis.z());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::pair<double, double>>{
                       {0.0, -1.0}, {10.0, 1.0}, {11.0, -1.0}, {20.0, 1.0}, {20.5, 1.0}}));
}

TEST(Brep, LayersWhoseOutlinesCrossAreRefused) {
  const ToothProfile lower = profile_of(test::external_gear(39, 0.3));
  const ToothProfile upper = profile_of(test::external_gear(38, 0.3));
  const PartShape part{"planet",
                       {Slab{0.0, 5.0, ToothedOutline{&lower, 0.0}, {}},
                        Slab{5.0, 9.0, ToothedOutline{&upper, 0.0}, {}}}};
  const auto brep = brep_of(part);
  ASSERT_FALSE(brep);
  EXPECT_EQ(brep.error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace trueflank
