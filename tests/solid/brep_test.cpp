// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/brep.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"

namespace trueflank {
namespace {

using test::profile_of;

/// Direction in which an edge leaves its start, as its curve runs; chords do for splines.
Point3 direction_at_start(const Brep& brep, const BrepEdge& edge) {
  const Point3& start = brep.vertices[edge.start];
  if (const auto* c = std::get_if<CircleCurve>(&brep.curves[edge.curve]))
    return c->frame.axis.cross(start - c->frame.origin).normalized();
  if (const auto* s = std::get_if<SplineCurve>(&brep.curves[edge.curve]))
    return (s->poles[2] - s->poles[0]).normalized();
  return std::get<LineCurve>(brep.curves[edge.curve]).direction;
}

/// Outward normal of a side face where a horizontal edge starts.
Point3 normal_at_start(const Brep& brep, const BrepFace& face, const BrepEdge& edge) {
  const Point3& start = brep.vertices[edge.start];
  const double sense = face.same_sense ? 1.0 : -1.0;
  const BrepSurface& surface = brep.surfaces[face.surface];
  if (const auto* plane = std::get_if<PlaneSurface>(&surface)) return sense * plane->frame.axis;
  if (const auto* cylinder = std::get_if<CylinderSurface>(&surface)) {
    Point3 radial = start - cylinder->frame.origin;
    radial.z() = 0.0;
    return sense * radial.normalized();
  }
  return sense * direction_at_start(brep, edge).cross(std::get<ExtrusionSurface>(surface).direction);
}

/// Twice the area that the vertices of a loop enclose seen from +z; a circle counts as one turn.
double turning(const Brep& brep, const BrepLoop& loop) {
  if (loop.size() == 1) return loop[0].forward ? 1.0 : -1.0;
  double sum = 0.0;
  for (const OrientedEdge& e : loop) {
    const BrepEdge& edge = brep.edges[e.edge];
    const Point3 &a = brep.vertices[edge.start], &b = brep.vertices[edge.end];
    sum += (e.forward ? 1.0 : -1.0) * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// Every loop runs counter-clockwise about the normal that its face claims, and that normal leads
/// out of the material of the section.
template <class InMaterial>
void expect_outward(const std::string& name, const Brep& brep, const InMaterial& in_material) {
  for (const BrepFace& face : brep.faces) {
    const auto* plane = std::get_if<PlaneSurface>(&brep.surfaces[face.surface]);
    if (plane && std::abs(plane->frame.axis.z()) > 0.5) {
      const double up = plane->frame.axis.z() * (face.same_sense ? 1.0 : -1.0);
      for (std::size_t i = 0; i < face.loops.size(); ++i)
        EXPECT_GT(turning(brep, face.loops[i]) * up * (i == 0 ? 1.0 : -1.0), 0.0) << name;
      continue;
    }
    for (const OrientedEdge& e : face.loops.front()) {
      const BrepEdge& edge = brep.edges[e.edge];
      const Point3& start = brep.vertices[edge.start];
      const Point3 along = direction_at_start(brep, edge) * (e.forward ? 1.0 : -1.0);
      if (std::abs(along.z()) > 0.5) continue;
      const Point3 normal = normal_at_start(brep, face, edge);
      // the face lies to the left of the edge: above its lower, below its upper one
      EXPECT_GT(normal.cross(along).z() * (start.z() > 1e-9 ? -1.0 : 1.0), 0.0) << name;
      const Point3 inside = start + 1e-2 * direction_at_start(brep, edge);
      EXPECT_FALSE(in_material(Point2((inside + 5e-3 * normal).head<2>()))) << name;
      EXPECT_TRUE(in_material(Point2((inside - 5e-3 * normal).head<2>()))) << name;
    }
  }
}

TEST(Brep, NormalsLeadOutOfTheMaterialAndLoopsRunRoundThem) {
  for (const auto& [name, gear] : test::sample_gears()) {
    if (gear.normal_module_mm < 0.5) continue;  // the probes are 5 um long
    const ToothProfile profile = profile_of(gear);
    const bool ring = gear.kind == GearKind::kInternal;
    const PartShape part = ring ? test::ring_part(name, profile, 7.5)
                                : test::gear_part(name, profile, 7.5, {BoreOutline{{.diameter_mm = 2.0}}});
    const auto brep = brep_of(part);
    ASSERT_TRUE(brep) << name;
    const auto teeth = path_polygon(outline_path(ToothedOutline{&profile, 0.0}));
    const double other_mm = ring ? std::get<CircleOutline>(part.slabs[0].outer).radius_mm : 1.0;
    expect_outward(name, *brep, [&](const Point2& p) {
      return contains(teeth, p) != ring && (p.norm() < other_mm) == ring;
    });
  }
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

TEST(Brep, RandomGearsAreClosedAndWithinTheTolerance) {
  std::mt19937 random(20);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  int made = 0;
  for (int i = 0; i < 200; ++i) {
    const bool ring = i % 2 == 0;
    const int teeth = static_cast<int>(ring ? between(14, 100) : between(5, 100));
    Gear gear = ring ? test::ring_gear(teeth, 0.0) : test::external_gear(teeth, 0.0);
    gear.normal_module_mm = std::exp(between(std::log(0.1), std::log(12.0)));
    gear.rack.pressure_angle_rad = between(0.18, 0.6);
    gear.rack.addendum = between(0.6, 1.2);
    gear.rack.dedendum = gear.rack.addendum + between(0.05, 0.5);
    gear.rack.root_radius = i % 5 == 0 ? 0.0 : between(0.0, 0.6);
    gear.shift = between(-0.6, 1.2);
    if (i % 4 == 0) {
      gear.ring_root = RingRoot::kShaper;
      gear.cutter = ShaperCutter{static_cast<int>(between(8, 0.8 * teeth)), between(-0.2, 0.5), between(0.0, 0.4)};
    }
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    const auto profile = ToothProfile::make(gear);
    if (!profile) continue;  // there is no such gear
    ++made;
    const auto brep = brep_of(ring ? test::ring_part("ring", *profile, 5.0)
                                   : test::gear_part("gear", *profile, 5.0));
    ASSERT_TRUE(brep) << i;
    EXPECT_TRUE(is_closed(*brep)) << i;
    EXPECT_LE(brep->fit_error_mm, 5e-6) << i;
  }
  EXPECT_GT(made, 100);
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
