// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/outline_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/flank_distance.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"

namespace trueflank {
namespace {

using test::profile_of;

/// Points on a path, `steps` a piece.
std::vector<Point2> points_of(const OutlinePath& path, int steps) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const PathPiece& piece = path.pieces[i];
    const Point2 end = path.pieces[(i + 1) % path.pieces.size()].start;
    for (int k = 0; k < steps; ++k) {
      const double u = static_cast<double>(k) / steps;
      if (const auto* s = std::get_if<PathSpline>(&piece.shape)) {
        points.push_back(point_at(s->spline, u));
      } else if (const auto* arc = std::get_if<PathArc>(&piece.shape)) {
        const PathCircle& c = path.circles[arc->circle];
        const double from = polar_angle_rad(piece.start - c.centre);
        const double span = wrapped_rad(polar_angle_rad(end - c.centre) - from);
        points.push_back(c.centre + c.radius_mm * unit_vector(from + u * span));
      } else {
        points.push_back((1.0 - u) * piece.start + u * end);
      }
    }
  }
  return points;
}

/// Distance of a point from the half profile of tooth 1 by dense search.
double distance_mm(const Point2& p, const std::vector<Point2>& half) {
  double best = 1e9;
  for (std::size_t i = 0; i + 1 < half.size(); ++i) {
    const Point2 edge = half[i + 1] - half[i];
    const double u = std::clamp((p - half[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - half[i] - u * edge).norm());
  }
  return best;
}

TEST(OutlinePath, FollowsTheProfileRoundAllTeeth) {
  for (const auto& [name, gear] : test::sample_gears()) {
    if (gear.normal_module_mm > 3.0 || gear.teeth > 100) continue;  // the search would be coarse
    const ToothProfile profile = profile_of(gear);
    std::vector<Point2> half;
    for (const ProfilePiece& piece : profile.pieces())
      for (int i = 0; i <= 400; ++i)
        half.push_back(point_at(piece.curve, piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / 400.0));
    const double rotation = 0.3, pitch = kTwoPi / gear.teeth;
    const OutlinePath path = outline_path(ToothedOutline{&profile, rotation});
    EXPECT_LE(path.fit_error_mm, 1e-7) << name;
    double last_angle = -1.0, turned = 0.0;
    for (const Point2& p : points_of(path, 7)) {
      const double angle = polar_angle_rad(p);
      if (last_angle != -1.0) turned += centred_rad(angle - last_angle);
      last_angle = angle;
      Point2 local = rotated(p, -rotation);
      const double tooth = std::round(polar_angle_rad(local) / pitch);
      local = rotated(local, -tooth * pitch);
      if (local.y() < 0.0) local = mirrored(local);
      EXPECT_LE(distance_mm(local, half), 1e-5) << name;  // most of it the search's own chords
    }
    EXPECT_NEAR(turned, kTwoPi, pitch) << name << ": once round, counter-clockwise";
  }
}

TEST(OutlinePath, AModifiedFlankIsSplitAtItsBendAndFollowsTheField) {
  for (const bool ring : {false, true}) {
    const Gear gear = ring ? test::ring_gear(40, 0.3) : test::external_gear(21, 0.2);
    const ToothProfile profile = profile_of(gear);
    const double start =
        0.5 * (profile.tip_form_roll_length_mm() + profile.root_form_roll_length_mm());
    const FlankDeviation relief = test::sample_modifications(gear, 9.0, start);
    const ToothedOutline outline{.profile = &profile, .rotation_rad = 0.4,
                                 .twist = {.face_width_mm = 9.0}, .deviation = &relief};
    const OutlinePath path = outline_path(outline);
    EXPECT_LE(path.fit_error_mm, 1e-7);
    // tip, root (not the ring's: a full round), and on either side a fillet and a flank of two pieces
    EXPECT_EQ(path.pieces.size(), gear.teeth * (ring ? 7U : 8U));
    const double lower = std::min(profile.tip_form_radius_mm(), profile.root_form_radius_mm()) + 1e-3;
    const double upper = std::max(profile.tip_form_radius_mm(), profile.root_form_radius_mm()) - 1e-3;
    int on_flanks = 0;
    for (const Point2& p : points_of(path, 9)) {
      if (p.norm() < lower || p.norm() > upper) continue;
      ++on_flanks;
      const Point2 own = rotated(p, -0.4);
      EXPECT_LE(test::flank_error_mm(outline.toothing(), {own.x(), own.y(), 4.5}, relief.deviation_mm),
                2e-8);
    }
    EXPECT_GT(on_flanks, gear.teeth * 30);
  }
}

TEST(OutlinePath, AHelicalSectionIsTheTransverseOneTurnedAsAtMidFace) {
  const Gear gear = test::helical_gear(21, 0.2, 0.3);
  const ToothProfile profile = profile_of(gear);
  const ToothedOutline straight{.profile = &profile, .rotation_rad = 0.1};
  for (const bool herringbone : {false, true}) {
    ToothedOutline twisted = straight;
    twisted.twist = face_twist(gear, 7.0, herringbone);
    const auto a = points_of(outline_path(straight), 5), b = points_of(outline_path(twisted), 5);
    ASSERT_EQ(a.size(), b.size());
    const double turn = 3.5 * std::tan(0.3) / reference_radius_mm(gear);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LE((rotated(a[i], turn) - b[i]).norm(), 1e-12);
  }
}

TEST(OutlinePath, AreaIsThatOfTheExactCurves) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const ToothProfile profile = profile_of(gear);
    const ToothedOutline outline{&profile, 1.1};
    const std::vector<Point2> points = points_of(outline_path(outline), 200);
    double area = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      area += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
    const double exact = test::area_mm2(outline);
    EXPECT_NEAR(area, exact, 1e-5 * exact) << name;
  }
}

TEST(OutlinePath, RoundedTipsFollowTheirArcs) {
  for (Gear gear : {test::external_gear(20, 0.1), test::ring_gear(45, 0.3)}) {
    gear.tip_rounding_mm = 0.12;
    const ToothProfile profile = profile_of(gear);
    const ToothedOutline outline{&profile, 0.0};
    const OutlinePath path = outline_path(outline);
    EXPECT_LE(path.fit_error_mm, 1e-7);
    double area = 0.0;
    const std::vector<Point2> points = points_of(path, 200);
    for (std::size_t i = 0; i < points.size(); ++i)
      area += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
    EXPECT_NEAR(area, test::area_mm2(outline), 1e-6 * area);
  }
}

TEST(OutlinePath, AFullRoundRingRootIsOneArc) {
  const ToothProfile round = profile_of(test::with_root_radius(test::ring_gear(60, 0.0), 1.0));
  const ToothProfile sharp = profile_of(test::with_root_radius(test::ring_gear(60, 0.0), 0.0));
  for (const ToothProfile* profile : {&round, &sharp})
    EXPECT_EQ(outline_path(ToothedOutline{profile, 0.0}).pieces.size(), 4U * 60U);
}

TEST(OutlinePath, APieceOfAFewNanometresIsLeftOut) {
  Gear gear = test::external_gear(9, 1.0);
  const double pointed = profile_of(gear).tip_radius_mm();
  gear.tip_radius_mm = pointed - 1e-6;  // a tip land of 2 nm
  const ToothProfile profile = profile_of(gear);
  ASSERT_EQ(profile.pieces().front().kind, PieceKind::kTip);
  const OutlinePath path = outline_path(ToothedOutline{&profile, 0.0});
  EXPECT_EQ(path.pieces.size() % 9, 0U);
  for (std::size_t i = 0; i < path.pieces.size(); ++i)
    EXPECT_GT((path.pieces[(i + 1) % path.pieces.size()].start - path.pieces[i].start).norm(), 1e-5);
  EXPECT_GT(path.fit_error_mm, 1e-7);
  EXPECT_LT(path.fit_error_mm, 5e-6);
}

TEST(OutlinePath, PolygonTellsInsideFromOutside) {
  const ToothProfile profile = profile_of(test::external_gear(20, 0.0));
  const auto polygon = path_polygon(outline_path(ToothedOutline{&profile, 0.0}));
  EXPECT_TRUE(contains(polygon, {0.0, 0.0}));
  EXPECT_TRUE(contains(polygon, {profile.tip_radius_mm() - 2e-3, 0.0}));
  EXPECT_FALSE(contains(polygon, {profile.tip_radius_mm() + 2e-3, 0.0}));
  const Point2 gap = unit_vector(kPi / 20.0);
  EXPECT_TRUE(contains(polygon, (profile.root_radius_mm() - 2e-3) * gap));
  EXPECT_FALSE(contains(polygon, (profile.root_radius_mm() + 2e-3) * gap));
}

}  // namespace
}  // namespace trueflank
