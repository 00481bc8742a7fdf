// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/polyline.h"

#include <gtest/gtest.h>

#include <random>

#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {
namespace {

std::vector<ToothProfile> some_profiles() {
  std::vector<ToothProfile> profiles;
  std::mt19937 random(3);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  while (profiles.size() < 24) {
    Gear gear{.kind = profiles.size() % 3 == 2 ? GearKind::kInternal : GearKind::kExternal,
              .teeth = static_cast<int>(uniform(7, 120)),
              .shift = uniform(-0.3, 1.2)};
    if (gear.kind == GearKind::kInternal) gear.teeth += 30;
    if (profiles.size() % 6 == 5) {
      gear.ring_root = RingRoot::kShaper;
      gear.cutter = ShaperCutter{.teeth = 20, .shift = 0.0, .tip_radius = 0.2};
    }
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    if (auto profile = ToothProfile::make(gear)) profiles.push_back(*profile);
  }
  return profiles;
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (a + t * d - p).norm();
}

/// Largest distance of the exact outline of one tooth from the polygon, by dense sampling.
double curve_to_polygon(const ToothProfile& profile, const SectionPolygon& section) {
  double worst = 0.0;
  const int n = static_cast<int>(section.points.size()), per = section.points_per_tooth;
  for (const ProfilePiece& piece : profile.pieces()) {
    for (int i = 0; i <= 400; ++i) {
      const double t = piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / 400.0;
      const Point2 p = point_at(piece.curve, t);
      double nearest = 1e300;
      for (int k = -per; k <= per; ++k) {
        const auto a = static_cast<std::size_t>((k + n) % n);
        const auto b = static_cast<std::size_t>((k + 1 + n) % n);
        nearest = std::min(nearest, distance_to_segment(p, section.points[a], section.points[b]));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(Polyline, KeepsTheToleranceAndReportsWhatItAchieved) {
  for (const ToothProfile& profile : some_profiles()) {
    for (double tolerance : {0.05, 0.01, 1e-3, 1e-4}) {
      const SectionPolygon section = section_polygon(profile, tolerance);
      const double measured = curve_to_polygon(profile, section);
      EXPECT_LE(section.chord_error_mm, tolerance * (1.0 + 1e-9));
      EXPECT_LE(measured, section.chord_error_mm * (1.0 + 1e-6) + 1e-12);
      EXPECT_GE(measured, 0.9 * section.chord_error_mm);
    }
  }
}

TEST(Polyline, VerticesAreOnTheCurve) {
  for (const ToothProfile& profile : some_profiles()) {
    const HalfToothPolyline half = tessellate(profile, 1e-3);
    ASSERT_EQ(half.edges.size() + 1, half.points.size());
    for (std::size_t i = 0; i < half.edges.size(); ++i) {
      const HalfToothPolyline::Edge& edge = half.edges[i];
      const Curve& curve = profile.pieces()[static_cast<std::size_t>(edge.piece)].curve;
      EXPECT_LT((point_at(curve, edge.from) - half.points[i]).norm(), 1e-9);
      EXPECT_LT((point_at(curve, edge.to) - half.points[i + 1]).norm(), 1e-9);
    }
  }
}

/// Least number of chords for one piece by an independent, crude march: the farthest of 20000 samples
/// whose chord stays within the tolerance.
int least_chords(const Curve& curve, double tolerance) {
  constexpr int kSamples = 20000;
  std::vector<Point2> points;
  for (int i = 0; i <= kSamples; ++i)
    points.push_back(point_at(curve, curve.begin + (curve.end - curve.begin) * i / kSamples));
  const auto within = [&](int a, int b) {
    double worst = 0.0;
    const int step = std::max(1, (b - a) / 50);
    for (int k = a; k < b; k += step)
      worst = std::max(worst, distance_to_segment(points[static_cast<std::size_t>(k)],
                                                  points[static_cast<std::size_t>(a)],
                                                  points[static_cast<std::size_t>(b)]));
    return worst <= tolerance;
  };
  int chords = 0;
  for (int at = 0; at < kSamples; ++chords) {
    int low = at + 1, high = kSamples;
    while (low < high) {
      const int mid = (low + high + 1) / 2;
      if (within(at, mid)) low = mid; else high = mid - 1;
    }
    at = low;
  }
  return chords;
}

TEST(Polyline, UsesNoMoreChordsThanNeeded) {
  int used = 0, least = 0;
  for (const ToothProfile& profile : some_profiles()) {
    const HalfToothPolyline half = tessellate(profile, 1e-3);
    for (std::size_t k = 0; k < profile.pieces().size(); ++k) {
      const PieceKind kind = profile.pieces()[k].kind;
      if (kind == PieceKind::kTip || kind == PieceKind::kRoot) continue;
      used += static_cast<int>(std::count_if(
          half.edges.begin(), half.edges.end(),
          [&](const auto& edge) { return edge.piece == static_cast<int>(k); }));
      least += least_chords(profile.pieces()[k].curve, 1e-3);
    }
  }
  EXPECT_LE(used, least + least / 100);
}

TEST(Polyline, FilletThatSwingsAcrossItsChordKeepsTheTolerance) {
  // the trochoid of this gear is nearly straight, with an inflection: humps on either side of a chord
  const Gear gear{.teeth = 8,
                  .normal_module_mm = 1.13543,
                  .rack = {.pressure_angle_rad = rad_from_deg(17.4776),
                           .addendum = 1.03444,
                           .dedendum = 1.36439,
                           .root_radius = 0.4327},
                  .shift = 1.45868,
                  .thinning_mm = 0.0431,
                  .tip_radius_mm = 7.37246};
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  for (double tolerance = 1e-5; tolerance < 1e-2; tolerance *= 1.05) {
    const HalfToothPolyline half = tessellate(*profile, tolerance);
    for (const auto& edge : half.edges) {
      const Curve& curve = profile->pieces()[static_cast<std::size_t>(edge.piece)].curve;
      const Point2 a = point_at(curve, edge.from), b = point_at(curve, edge.to);
      for (int i = 1; i < 32; ++i) {
        const Point2 p = point_at(curve, edge.from + (edge.to - edge.from) * i / 32.0);
        ASSERT_LE(distance_to_segment(p, a, b), half.chord_error_mm * (1.0 + 1e-6) + 1e-13);
      }
    }
  }
}

TEST(Polyline, PieceFarBelowTheToleranceLeavesNoShortEdge) {
  // a tip circle 1 nm inside the point where the flanks meet: the tip land is far below any tolerance
  Gear gear{.teeth = 17, .shift = 0.8, .tip_radius_mm = 20.0};
  const auto pointed = ToothProfile::make(gear);
  ASSERT_TRUE(pointed && pointed->notes().pointed);
  gear.tip_radius_mm = pointed->tip_radius_mm() - 1e-6;
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  ASSERT_EQ(profile->pieces().front().kind, PieceKind::kTip);
  const SectionPolygon section = section_polygon(*profile, 1e-3);
  double shortest = 1.0;
  for (std::size_t i = 0; i < section.points.size(); ++i)
    shortest = std::min(
        shortest, (section.points[i] - section.points[(i + 1) % section.points.size()]).norm());
  EXPECT_GT(shortest, 0.25e-3);
  EXPECT_LE(section.chord_error_mm, 1e-3);
  EXPECT_LE(curve_to_polygon(*profile, section), section.chord_error_mm * (1.0 + 1e-6));
}

TEST(Polyline, StraightFlankInsideTheBaseCircleIsOneChord) {
  Gear gear{.kind = GearKind::kInternal, .teeth = 18, .shift = 0.0};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  const HalfToothPolyline half = tessellate(*profile, 1e-3);
  int radial = 0;
  for (const auto& edge : half.edges)
    radial += profile->pieces()[static_cast<std::size_t>(edge.piece)].kind == PieceKind::kRadial;
  EXPECT_EQ(radial, 1);
}

TEST(Polyline, SectionIsSymmetricAndPeriodic) {
  for (const ToothProfile& profile : some_profiles()) {
    const SectionPolygon section = section_polygon(profile, 1e-3);
    const auto per = static_cast<std::size_t>(section.points_per_tooth);
    ASSERT_EQ(section.points.size(), per * static_cast<std::size_t>(section.teeth));
    double area = 0.0;
    for (std::size_t i = 0; i < section.points.size(); ++i)
      area += 0.5 * cross(section.points[i], section.points[(i + 1) % section.points.size()]);
    EXPECT_GT(area, 0.0);
    for (std::size_t i = 0; i < per; ++i)
      EXPECT_LT((rotated(section.points[i], kTwoPi / section.teeth) - section.points[i + per]).norm(),
                1e-9);
  }
}

}  // namespace
}  // namespace trueflank
