// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths of a wire against an offset of the dense polygon, both ways, by plain distances of points and
// segments: nothing of the library's own offset curves or distances is used.
#include "trueflank/export/section/kerf_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/sample_gears.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/biarc.h"

namespace trueflank::io {
namespace {

constexpr double kTolerance_mm = 1e-3;
constexpr double kPolygon_mm = 2e-6;

std::vector<Point2> polygon_of(const Outline& outline) {
  std::vector<Point2> points;
  for (const ContourVertex& vertex : contour_of(outline, kPolygon_mm).vertices)
    points.push_back(vertex.point);
  return points;
}

/// Sorted into cells by angle, so that a distance looks at near edges only.
class PolygonDistance {
 public:
  explicit PolygonDistance(const std::vector<Point2>& points) : points_(points), cells_(kCells) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point2 &a = points[i], &b = points[(i + 1) % points.size()];
      const int from = cell(a), turns = (cell(b) - from + kCells) % kCells;
      for (int k = 0; k <= (turns < kCells / 2 ? turns : 0); ++k)
        cells_[static_cast<std::size_t>((from + k) % kCells)].push_back(i);
      if (turns >= kCells / 2)  // runs clockwise
        for (int k = 0; k <= kCells - turns; ++k)
          cells_[static_cast<std::size_t>((from - k + kCells) % kCells)].push_back(i);
    }
  }
  [[nodiscard]] double operator()(const Point2& p, double reach_mm) const {
    const double angle = std::asin(std::min(1.0, reach_mm / p.norm()));
    const int wide = static_cast<int>(std::ceil(angle / kTwoPi * kCells)) + 1;
    double nearest = 1e9;
    for (int k = -wide; k <= wide; ++k)
      for (std::size_t i : cells_[static_cast<std::size_t>((cell(p) + k + 2 * kCells) % kCells)]) {
        const Point2 &a = points_[i], d = points_[(i + 1) % points_.size()] - a;
        const double along = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - a - along * d).norm());
      }
    return nearest;
  }

 private:
  static constexpr int kCells = 2000;
  static int cell(const Point2& p) {
    return static_cast<int>(wrapped_rad(polar_angle_rad(p)) / kTwoPi * kCells) % kCells;
  }
  const std::vector<Point2>& points_;
  std::vector<std::vector<std::size_t>> cells_;
};

struct Edges {
  std::vector<ArcEdge> edges;
  [[nodiscard]] Point2 end(std::size_t i) const { return edges[(i + 1) % edges.size()].start; }
};
Edges edges_of(const Contour& contour) {
  Edges result;
  for (const ContourVertex& vertex : contour.vertices)
    result.edges.push_back({vertex.point, vertex.bulge});
  return result;
}

bool segments_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double s = cross(b - a, c - a), t = cross(b - a, d - a);
  const double u = cross(d - c, a - c), v = cross(d - c, b - c);
  return s * t < 0.0 && u * v < 0.0;
}

void expect_true_offset(const std::string& name, const Outline& outline, bool hole, double kerf_mm) {
  SCOPED_TRACE(name + ", kerf " + std::to_string(kerf_mm));
  const auto made = kerf_path(outline, hole, kerf_mm, kTolerance_mm);
  ASSERT_TRUE(made);
  EXPECT_LE(made->deviation_mm, kTolerance_mm);
  const double d = 0.5 * kerf_mm;
  const std::vector<Point2> polygon = polygon_of(outline);
  const PolygonDistance distance(polygon);
  const Edges path = edges_of(made->path);
  // every point of the path is half the kerf from the outline
  std::vector<Point2> dense;
  double worst = 0.0;
  for (std::size_t i = 0; i < path.edges.size(); ++i) {
    // chords 2 um from their arcs at most
    const double angle = 4.0 * std::abs(std::atan(path.edges[i].bulge));
    const int count = std::max(6, static_cast<int>(std::ceil(angle / 0.02)));
    for (int k = 0; k < count; ++k) {
      dense.push_back(point_on(path.edges[i], path.end(i), static_cast<double>(k) / count));
      worst = std::max(worst, std::abs(distance(dense.back(), 1.2 * d) - d));
    }
  }
  EXPECT_LE(worst, kTolerance_mm + 1e-5);
  // every point of the true offset is on the path
  double missed = 0.0;
  const PolygonDistance to_path(dense);
  const double side = hole ? -1.0 : 1.0;
  const std::size_t step = std::max<std::size_t>(1, polygon.size() / 6000);
  for (std::size_t i = 0; i < polygon.size(); i += step) {
    const Point2 along = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Point2 q = 0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]) -
                     side * d * perpendicular(along.normalized());
    if (distance(q, 1.2 * d) < d - 1e-4) continue;  // cut off
    missed = std::max(missed, to_path(q, 1.2 * d));
  }
  EXPECT_LE(missed, 2.0 * kTolerance_mm);  // dense points are chords of the arcs
  // and it does not cross itself
  int crossings = 0;
  const std::size_t n = dense.size(), window = std::min<std::size_t>(n, 700);
  for (std::size_t i = 0; i < n; i += 2)
    for (std::size_t k = i + 2; k < i + window; k += 2)
      if ((k + 2) % n != i % n && k % n != i)
        crossings += segments_cross(dense[i % n], dense[(i + 2) % n], dense[k % n], dense[(k + 2) % n]);
  EXPECT_EQ(crossings, 0);
}

TEST(KerfPath, IsTheTrueOffsetOfTeeth) {
  bool wide = false;
  for (const test::SampleGear& sample : test::sample_gears()) {
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile) << sample.name;
    if (profile->gear().teeth > 100) continue;
    const bool ring = profile->gear().kind == GearKind::kInternal;
    const double m = profile->gear().normal_module_mm;
    const double kerf = (wide = !wide) ? 0.35 * m : 0.1 * m;
    expect_true_offset(sample.name, ToothedOutline{&*profile, 0.3}, ring, kerf);
  }
}

/// Tip and root relief as parabolas in the roll length, and profile crowning.
FlankDeviation relieved(const ToothProfile& profile) {
  const double root = profile.root_form_roll_length_mm(), tip = profile.tip_form_roll_length_mm();
  const double middle = std::lerp(root, tip, 0.5);
  FlankDeviation field;
  field.deviation_mm = [=](int, Flank, double roll, double) {
    const double u = (roll - middle) / (tip - middle);
    return -0.004 * u * u - (u > 0.0 ? 0.02 * u * u : 0.0);
  };
  field.roll_breaks_mm = {middle};
  return field;
}

TEST(KerfPath, IsTheTrueOffsetOfModifiedProfiles) {
  for (const Gear& gear : {test::external_gear(24, 0.1), test::external_gear(8, 0.1), test::ring_gear(40, 0.2),
                           test::with_tip_rounding(test::external_gear(30, 0.0), 0.1)}) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile);
    const FlankDeviation field = relieved(*profile);
    const bool ring = gear.kind == GearKind::kInternal;
    const ToothedOutline teeth{.profile = &*profile, .rotation_rad = 0.2,
                               .twist = {.face_width_mm = 5.0}, .deviation = &field};
    expect_true_offset(std::to_string(gear.teeth) + " teeth, relieved", teeth, ring, 0.25);
    // and not that of the unmodified teeth
    const auto made = kerf_path(teeth, ring, 0.25, kTolerance_mm);
    const auto plain = kerf_path(ToothedOutline{.profile = &*profile, .rotation_rad = 0.2}, ring, 0.25,
                                 kTolerance_mm);
    ASSERT_TRUE(made && plain);
    const Edges path = edges_of(plain->path);
    double apart = 0.0;
    for (std::size_t i = 0; i < made->path.vertices.size() / static_cast<std::size_t>(gear.teeth); ++i) {
      double nearest = 1e9;
      for (std::size_t k = 0; k < path.edges.size(); ++k)
        nearest = std::min(nearest, distance_mm(path.edges[k], path.end(k), made->path.vertices[i].point));
      apart = std::max(apart, nearest);
    }
    EXPECT_GT(apart, 0.015);
  }
}

TEST(KerfPath, IsRefusedForWhatNoStraightWireCuts) {
  const auto profile = ToothProfile::make(test::external_gear(24, 0.1));
  ASSERT_TRUE(profile);
  FlankDeviation crowned = relieved(*profile);
  crowned.varies_along_face = true;
  const ToothedOutline straight{.profile = &*profile, .twist = {.face_width_mm = 5.0}};
  ToothedOutline helical = straight, bowed = straight, edged = straight;
  helical.twist.turn_rad_per_mm = 0.01;
  bowed.deviation = &crowned;
  edged.edge_chamfer_mm = 0.2;
  for (const auto& [teeth, word] : {std::pair{helical, "cannot cut helical teeth"},
                                    std::pair{bowed, "cannot cut flanks that change along the face"},
                                    std::pair{edged, "cannot cut an edge chamfer"}}) {
    const auto made = kerf_path(teeth, false, 0.25, kTolerance_mm);
    ASSERT_FALSE(made) << word;
    EXPECT_EQ(made.error().key, "made.kerf_mm");
    EXPECT_NE(made.error().message.find(word), std::string::npos) << made.error().message;
  }
}

TEST(KerfPath, IsTheTrueOffsetOfBores) {
  const BoreDesign keyway{.diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 3.0,
                          .keyway_depth_mm = 1.4};
  const BoreDesign flat{.diameter_mm = 6.0, .kind = BoreKind::kDFlat, .d_flat_mm = 5.2};
  const BoreDesign hex{.diameter_mm = 6.0, .kind = BoreKind::kHex};
  for (const double kerf : {0.2, 0.5}) {
    expect_true_offset("keyway", BoreOutline{keyway}, true, kerf);
    expect_true_offset("flat", BoreOutline{flat}, true, kerf);
    expect_true_offset("hexagon", BoreOutline{hex}, true, kerf);
  }
}

TEST(KerfPath, TellsTheCornersThatTheWireDoesNotReach) {
  // inner corners of 120 and 90 degrees: r (1 / sin(half the angle) - 1) stays
  const BoreDesign hex{.diameter_mm = 6.0, .kind = BoreKind::kHex};
  const auto hexagon = kerf_path(BoreOutline{hex}, true, 0.5, kTolerance_mm);
  ASSERT_TRUE(hexagon);
  ASSERT_EQ(hexagon->corners.size(), 6u);
  for (const UnreachedCorner& corner : hexagon->corners) {
    EXPECT_NEAR(corner.left_mm, 0.25 * (2.0 / std::sqrt(3.0) - 1.0), 1e-6);
    EXPECT_NEAR(corner.place.norm(), (3.0 - 0.25) * 2.0 / std::sqrt(3.0), 1e-9);
  }
  const BoreDesign keyway{.diameter_mm = 8.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 3.0,
                          .keyway_depth_mm = 1.4};
  const auto key = kerf_path(BoreOutline{keyway}, true, 0.3, kTolerance_mm);
  ASSERT_TRUE(key);
  ASSERT_EQ(key->corners.size(), 2u);
  EXPECT_NEAR(key->corners[0].left_mm, 0.15 * (std::sqrt(2.0) - 1.0), 1e-6);
  // a root radius below the wire's: every gap
  Gear gear = test::ring_gear(40, 0.0);
  gear.rack.root_radius = 0.1;
  const auto profile = ToothProfile::make(gear);
  const auto thick = kerf_path(ToothedOutline{&*profile, 0.0}, true, 0.3, kTolerance_mm);
  ASSERT_TRUE(thick);
  EXPECT_EQ(thick->corners.size(), 80u);
  const auto thin = kerf_path(ToothedOutline{&*profile, 0.0}, true, 0.18, kTolerance_mm);
  ASSERT_TRUE(thin);
  EXPECT_TRUE(thin->corners.empty());
}

TEST(KerfPath, WhatComesOutIsHalfTheKerfFromThePath) {
  Gear gear = test::ring_gear(40, 0.0);
  gear.rack.root_radius = 0.1;
  const auto profile = ToothProfile::make(gear);
  const auto made = kerf_path(ToothedOutline{&*profile, 0.0}, true, 0.3, 1e-4);
  ASSERT_TRUE(made);
  const Edges path = edges_of(made->path), cut = edges_of(made->as_cut);
  for (std::size_t i = 0; i < cut.edges.size() / 40; ++i) {
    const Point2 p = point_on(cut.edges[i], cut.end(i), 0.4);
    double nearest = 1e9;
    for (std::size_t k = 0; k < path.edges.size(); ++k)
      nearest = std::min(nearest, distance_mm(path.edges[k], path.end(k), p));
    EXPECT_NEAR(nearest, 0.15, 3e-4);
  }
}

TEST(KerfPath, TakesFewArcs) {
  const auto profile = ToothProfile::make(test::external_gear(20, 0.0));
  const auto made = kerf_path(ToothedOutline{&*profile, 0.0}, false, 0.25, kTolerance_mm);
  ASSERT_TRUE(made);
  EXPECT_LE(made->path.vertices.size(), 20u * 40u);
}

TEST(KerfPath, WireThatDoesNotFitIsAnError) {
  for (const Outline& hole : {Outline(CircleOutline{Point2::Zero(), 0.1}),
                              Outline(BoreOutline{{.diameter_mm = 0.2, .kind = BoreKind::kHex}})}) {
    const auto made = kerf_path(hole, true, 0.3, kTolerance_mm);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().key, "made.kerf_mm");
  }
}

}  // namespace
}  // namespace trueflank::io
