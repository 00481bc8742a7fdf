// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/bezier_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/sample_gears.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

bool is_spline_piece(const ProfilePiece& piece) {
  return !std::holds_alternative<CircularArc>(piece.curve.shape) &&
         !std::holds_alternative<StraightLine>(piece.curve.shape);
}

/// Distance of a point from an involute on the counter-clockwise side, measured along the normal:
/// the involute's polar angle at the point's radius, nothing of the fit's own parameter.
double distance_from_involute_mm(const Point2& p, const Involute& c) {
  const double angle = pressure_angle_at_radius_rad(p.norm(), c.base_radius_mm);
  const double off = polar_angle_rad(p) - c.base_half_angle_rad -
                     c.sense * involute_function(angle);
  return std::abs(off) * c.base_radius_mm;
}

/// Distance of a point from a curve, found by search over its parameter.
double distance_mm(const Point2& p, const Curve& curve) {
  constexpr int kCoarse = 400;
  const double step = (curve.end - curve.begin) / kCoarse;
  double best = curve.begin;
  const auto at = [&](double t) { return (point_at(curve, t) - p).norm(); };
  for (int i = 0; i <= kCoarse; ++i)
    if (at(curve.begin + i * step) < at(best)) best = curve.begin + i * step;
  double low = best - step, high = best + step;
  if (low > high) std::swap(low, high);
  low = std::max(low, std::min(curve.begin, curve.end));
  high = std::min(high, std::max(curve.begin, curve.end));
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3.0;
    if (at(low + third) < at(high - third))
      high -= third;
    else
      low += third;
  }
  return at(0.5 * (low + high));
}

TEST(BezierFit, InvoluteIsOneSpanWithinItsTolerance) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << name << ": " << profile.error().message;
    for (const ProfilePiece& piece : profile->pieces()) {
      if (piece.kind != PieceKind::kInvolute) continue;
      const BezierFit fit = fit_bezier(piece.curve, 1e-8);
      EXPECT_EQ(fit.spline.spans(), 1) << name;
      EXPECT_LE(fit.error_mm, 1e-8) << name;
      const auto& involute = std::get<Involute>(piece.curve.shape);
      for (int i = 0; i <= 1000; ++i)
        EXPECT_LE(distance_from_involute_mm(point_at(fit.spline, i / 1000.0), involute), 1.01e-8)
            << name;
    }
  }
}

TEST(BezierFit, EveryPieceOfEveryProfileStaysWithinTheTolerance) {
  for (const auto& [name, gear] : test::sample_gears()) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << name;
    for (const ProfilePiece& piece : profile->pieces()) {
      if (!is_spline_piece(piece)) continue;
      for (const double tolerance : {1e-5, 1e-7, 1e-8}) {
        const BezierFit fit = fit_bezier(piece.curve, tolerance);
        EXPECT_LE(fit.error_mm, tolerance) << name;
        for (int i = 0; i <= 50; ++i)
          EXPECT_LE(distance_mm(point_at(fit.spline, i / 50.0), piece.curve), 1.05 * tolerance)
              << name << " at " << i / 50.0;
      }
    }
  }
}

TEST(BezierFit, EndsAreThoseOfTheCurveToTheLastBit) {
  const auto profile = ToothProfile::make(test::external_gear(39, 0.3));
  ASSERT_TRUE(profile);
  for (const ProfilePiece& piece : profile->pieces()) {
    if (!is_spline_piece(piece)) continue;
    const BezierFit fit = fit_bezier(piece.curve, 1e-7);
    EXPECT_EQ(fit.spline.poles.front(), piece.curve.start_point());
    EXPECT_EQ(fit.spline.poles.back(), piece.curve.end_point());
  }
}

TEST(BezierFit, TrochoidIsOneSmoothSplineOfFewSpans) {
  const auto profile = ToothProfile::make(test::external_gear(39, 0.3));
  ASSERT_TRUE(profile);
  const auto& pieces = profile->pieces();
  const auto fillet = std::find_if(pieces.begin(), pieces.end(), [](const ProfilePiece& p) {
    return p.kind == PieceKind::kFillet;
  });
  ASSERT_NE(fillet, pieces.end());
  const BezierFit fit = fit_bezier(fillet->curve, 1e-7);
  EXPECT_LE(fit.spline.spans(), 6);
  for (std::size_t i = 1; i + 1 < fit.spline.multiplicities.size(); ++i)
    EXPECT_EQ(fit.spline.multiplicities[i], 1);
  const int knots =
      std::accumulate(fit.spline.multiplicities.begin(), fit.spline.multiplicities.end(), 0);
  EXPECT_EQ(knots, static_cast<int>(fit.spline.poles.size()) + fit.spline.degree + 1);
}

}  // namespace
}  // namespace trueflank
