// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solids of teeth that change along the face: closed, their edges on their faces, their flanks where
// the equation of the involute has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/solid/random_part.h"
#include "tests/support/flank_distance.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/brep/spline_patch.h"

namespace trueflank {
namespace {

using test::profile_of;

struct Patch {
  SplineBasis u, v;
  const std::vector<Point3>* poles = nullptr;
  explicit Patch(const SplineSurface& s)
      : u(s.degree_u, s.knots_u), v(s.degree_v, s.knots_v), poles(&s.poles) {}
  Point3 at(double a, double b) const { return patch_point(u, v, *poles, a, b); }
};

Point3 curve_point(const SplineCurve& s, double at) {
  const SplineBasis basis(s.degree, s.knots);
  const BasisWeights w = basis.at(at);
  Point3 sum = Point3::Zero();
  for (int j = 0; j <= s.degree; ++j) sum += w.weight[j] * s.poles[w.first + j];
  return sum;
}

/// Largest distance of the spline edges of a face from its surface: of the rim of a patch, of a
/// cylinder, of a plane.
double edges_off_face_mm(const Brep& brep, const BrepFace& face) {
  double worst = 0.0;
  for (const BrepLoop& loop : face.loops)
    for (const OrientedEdge& oriented : loop) {
      const auto* edge = std::get_if<SplineCurve>(&brep.curves[brep.edges[oriented.edge].curve]);
      if (!edge) continue;
      for (int i = 0; i <= 10; ++i) {
        const Point3 p = curve_point(*edge, i / 10.0);
        double off = 1e9;
        const BrepSurface& surface = brep.surfaces[face.surface];
        if (const auto* cylinder = std::get_if<CylinderSurface>(&surface)) {
          off = std::abs(p.head<2>().norm() - cylinder->radius_mm);
        } else if (const auto* plane = std::get_if<PlaneSurface>(&surface)) {
          off = std::abs((p - plane->frame.origin).dot(plane->frame.axis));
        } else if (const auto* s = std::get_if<SplineSurface>(&surface)) {
          const Patch patch(*s);
          for (const double end : {0.0, 1.0}) {
            off = std::min(off, (patch.at(i / 10.0, end) - p).norm());
            off = std::min(off, (patch.at(end, i / 10.0) - p).norm());
          }
        }
        worst = std::max(worst, off);
      }
    }
  return worst;
}

/// Largest distance of the solid's flanks from where they should be; how many there are.
struct FlankFaces {
  double error_mm = 0.0;
  int count = 0;
};
FlankFaces flank_faces(const Brep& brep, const Toothing& toothing,
                       const test::WantedDeviation& wanted = {},
                       const std::function<Point3(const Point3&)>& undo = {}) {
  const ToothProfile& profile = *toothing.profile;
  const double low = std::min(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  const double high = std::max(profile.tip_form_radius_mm(), profile.root_form_radius_mm());
  FlankFaces found;
  for (const BrepSurface& surface : brep.surfaces) {
    const auto* s = std::get_if<SplineSurface>(&surface);
    if (!s) continue;
    const Patch patch(*s);
    const auto point = [&](double u, double v) {
      const Point3 p = patch.at(u, v);
      return undo ? undo(p) : p;
    };
    const double middle = point(0.5, 0.5).head<2>().norm();
    if (!(middle > low && middle < high)) continue;
    const double first = point(0.0, 0.5).head<2>().norm(), last = point(1.0, 0.5).head<2>().norm();
    if (std::abs(first - last) < 1e-3) continue;  // a land in a chamfer
    ++found.count;
    for (int i = 0; i <= 16; ++i)
      for (int j = 0; j <= 11; ++j) {
        const Point3 p = point(i / 16.0, j / 11.0);
        found.error_mm = std::max(
            found.error_mm, test::flank_error_mm(toothing, {p.x(), p.y(), p.z()}, wanted));
      }
  }
  return found;
}

void expect_sound(const Brep& brep, const std::string& what) {
  EXPECT_TRUE(is_closed(brep)) << what;
  EXPECT_LE(brep.fit_error_mm, 1e-5) << what;
  double off = 0.0;
  for (const BrepFace& face : brep.faces) off = std::max(off, edges_off_face_mm(brep, face));
  EXPECT_LE(off, 1e-6) << what;
}

TEST(BrepToothed, AFlankAndAFilletSideAreOneFaceEachAndHalvesOfAHerringboneAreTwo) {
  const ToothProfile profile = profile_of(test::helical_gear(23, 0.2, 0.35));
  for (const bool herringbone : {false, true}) {
    const auto brep = brep_of(test::helical_part("gear", profile, 10.0, herringbone));
    ASSERT_TRUE(brep);
    expect_sound(*brep, "gear");
    EXPECT_EQ(brep->faces.size(), 23U * 6U * (herringbone ? 2U : 1U) + 2U);
    const auto cylinders =
        std::count_if(brep->surfaces.begin(), brep->surfaces.end(), [](const BrepSurface& s) {
          return std::holds_alternative<CylinderSurface>(s);
        });
    EXPECT_EQ(cylinders, 23 * 2 * (herringbone ? 2 : 1));
  }
}

TEST(BrepToothed, RandomHelicalTeethAreClosedAndOnTheirHelicoids) {
  int made = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::RandomNumbers random(seed);
    const bool ring = random.chance(0.4), herringbone = random.chance(0.4);
    Gear gear = ring ? test::ring_gear(static_cast<int>(random.between(30.0, 90.0)), 0.0)
                     : test::external_gear(static_cast<int>(random.between(6.0, 50.0)), 0.0);
    gear.normal_module_mm = random.log_between(0.3, 5.0);
    gear.shift = random.between(-0.3, 0.8);
    gear.helix_angle_rad = random.between(-0.7, 0.7);
    gear.rack.root_radius = random.chance(0.2) ? 0.0 : random.between(0.0, 0.45);
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    const double width = gear.normal_module_mm * random.between(2.0, 15.0);
    const auto profile = ToothProfile::make(gear);
    if (!profile) continue;  // there is no such gear
    ++made;
    const std::string what = "seed " + std::to_string(seed);
    const auto brep = brep_of(test::helical_part("gear", *profile, width, herringbone));
    ASSERT_TRUE(brep) << what << ": " << brep.error().message;
    expect_sound(*brep, what);
    const Toothing toothing{.profile = &*profile, .twist = face_twist(gear, width, herringbone)};
    const FlankFaces flanks = flank_faces(*brep, toothing);
    EXPECT_EQ(flanks.count, 2 * gear.teeth * (herringbone ? 2 : 1)) << what;
    EXPECT_LE(flanks.error_mm, 1e-6) << what;  // the contract is 1e-5 mm
  }
  EXPECT_GE(made, 30);
}

TEST(BrepToothed, ModifiedFlanksAreSplitWhereTheyBendAndFollowTheField) {
  for (const double helix : {0.0, 0.3})
    for (const bool ring : {false, true}) {
      const Gear gear = ring ? test::helical_ring(40, 0.3, helix) : test::helical_gear(21, 0.2, helix);
      const ToothProfile profile = profile_of(gear);
      const double start =
          0.5 * (profile.tip_form_roll_length_mm() + profile.root_form_roll_length_mm());
      const FlankDeviation deviation = test::sample_modifications(gear, 9.0, start);
      const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 9.0, false),
                              .deviation = &deviation};
      const auto brep = brep_of(test::toothed_part("gear", toothing));
      ASSERT_TRUE(brep) << brep.error().message;
      expect_sound(*brep, "gear");
      const FlankFaces flanks = flank_faces(*brep, toothing, deviation.deviation_mm);
      EXPECT_EQ(flanks.count, 2 * gear.teeth * 2 * 3);
      EXPECT_LE(flanks.error_mm, 1e-6);
    }
}

TEST(BrepToothed, ASmoothFieldLeavesAFlankOneFace) {
  const ToothProfile profile = profile_of(test::external_gear(18, 0.2));
  FlankDeviation crowning;
  crowning.deviation_mm = [](int tooth, Flank, double, double z) {
    return -0.01 * (z / 4.0 - 1.0) * (z / 4.0 - 1.0) + 0.002 * std::cos(0.35 * tooth);
  };
  crowning.varies_along_face = crowning.varies_by_tooth = true;
  const Toothing toothing{.profile = &profile, .twist = {.face_width_mm = 8.0},
                          .deviation = &crowning};
  const auto brep = brep_of(test::toothed_part("gear", toothing));
  ASSERT_TRUE(brep) << brep.error().message;
  expect_sound(*brep, "gear");
  EXPECT_EQ(brep->faces.size(), 18U * 6U + 2U);
  EXPECT_LE(flank_faces(*brep, toothing, crowning.deviation_mm).error_mm, 1e-6);
}

TEST(BrepToothed, EdgeChamfersAreFacesOfTheirOwn) {
  const Gear gear = test::helical_gear(19, 0.2, 0.25);
  const ToothProfile profile = profile_of(gear);
  const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 8.0, false),
                          .edge_chamfer_mm = 0.2};
  const auto brep = brep_of(test::toothed_part("gear", toothing));
  ASSERT_TRUE(brep) << brep.error().message;
  expect_sound(*brep, "gear");
  EXPECT_EQ(brep->faces.size(), 19U * 6U * 3U + 2U);
  const FlankFaces flanks = flank_faces(*brep, toothing);
  EXPECT_EQ(flanks.count, 19 * 2 * 3);
  EXPECT_LE(flanks.error_mm, 1e-6);
}

TEST(BrepToothed, ADisplacedToothingIsSplinesAllRound) {
  const Gear gear = test::helical_gear(12, 0.2, 0.25);
  const ToothProfile profile = profile_of(gear);
  const Displacement bent = [](const std::array<double, 3>& p) -> std::array<double, 3> {
    return {0.01 * std::sin(0.4 * p[1]) + 0.002 * p[2], 0.004 * std::cos(0.3 * p[0] + 0.2 * p[2]), 0.0};
  };
  const Toothing toothing{.profile = &profile, .twist = face_twist(gear, 8.0, true),
                          .displacement = &bent};
  const auto brep = brep_of(test::toothed_part("gear", toothing));
  ASSERT_TRUE(brep) << brep.error().message;
  expect_sound(*brep, "gear");
  EXPECT_EQ(brep->faces.size(), 12U * 6U * 2U + 2U);
  const auto undo = [&](const Point3& moved) -> Point3 {
    Point3 p = moved;
    for (int i = 0; i < 30; ++i) {
      const auto d = bent({p.x(), p.y(), p.z()});
      p = moved - Point3(d[0], d[1], d[2]);
    }
    return p;
  };
  const FlankFaces flanks = flank_faces(*brep, toothing, {}, undo);
  EXPECT_EQ(flanks.count, 12 * 2 * 2);
  EXPECT_LE(flanks.error_mm, 1e-6);
}

TEST(BrepToothed, WhatCannotBeASolidIsRefusedWithAReason) {
  const auto refused = [](const Toothing& toothing, const std::string& word) {
    const auto brep = brep_of(test::toothed_part("gear", toothing));
    ASSERT_FALSE(brep) << word;
    EXPECT_EQ(brep.error().code, ErrorCode::kUnsupported);
    EXPECT_NE(brep.error().message.find(word), std::string::npos) << brep.error().message;
  };
  const ToothProfile profile = profile_of(test::external_gear(12, 0.2));
  const Displacement lifted = [](const std::array<double, 3>&) -> std::array<double, 3> {
    return {0.0, 0.0, 0.01};
  };
  refused({.profile = &profile, .twist = {.face_width_mm = 5.0}, .displacement = &lifted}, "planes");
  const ToothProfile pointed = profile_of(test::external_gear(9, 1.0));
  FlankDeviation relief;
  relief.deviation_mm = [](int, Flank, double, double) { return -0.01; };
  refused({.profile = &pointed, .twist = {.face_width_mm = 5.0}, .deviation = &relief}, "pointed");
  FlankDeviation rough;
  rough.deviation_mm = [](int, Flank, double roll, double) { return 0.002 * std::sin(300.0 * roll); };
  rough.varies_along_face = true;
  refused({.profile = &profile, .twist = {.face_width_mm = 5.0}, .deviation = &rough}, "64 spans");
}

}  // namespace
}  // namespace trueflank
