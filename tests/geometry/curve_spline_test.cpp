// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/curve_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {
namespace {

Curve fillet_of(int teeth, double shift, double module_mm) {
  Gear gear{.teeth = teeth, .normal_module_mm = module_mm, .shift = shift};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  EXPECT_TRUE(profile);
  for (const ProfilePiece& piece : profile->pieces())
    if (piece.kind == PieceKind::kFillet) return piece.curve;
  return {};
}

TEST(CurveSpline, FootOfAPointOffTheTrochoidIsThePointItWasMovedFrom) {
  for (const auto& [teeth, shift, module_mm] :
       {std::tuple{8, 0.0, 1.0}, {39, 0.3, 0.2}, {120, -0.5, 5.0}}) {
    const Curve curve = fillet_of(teeth, shift, module_mm);
    const CurveSpline spline(curve);
    for (int i = 1; i < 200; ++i) {
      const double t = curve.begin + (curve.end - curve.begin) * i / 200.0;
      const Point2 on = point_at(curve, t), left = perpendicular(tangent_at(curve, t));
      for (double off_mm : {-0.03 * module_mm, 0.0, 0.01 * module_mm}) {
        const auto foot = spline.foot(on + off_mm * left, 1e9);
        ASSERT_TRUE(foot) << teeth << " teeth, place " << i;
        EXPECT_NEAR(foot->distance_mm, std::abs(off_mm), 1e-9 * std::max(1.0, module_mm));
        EXPECT_NEAR((foot->point - on).norm(), 0.0, 1e-7 * module_mm);
        if (off_mm != 0.0) {
          EXPECT_EQ(foot->on_left, off_mm > 0.0);
        }
      }
    }
  }
}

// Far points, where many nodes are nearly as near as the nearest: against samples of the curve.
TEST(CurveSpline, FootOfAFarPointIsTheNearestSample) {
  for (const bool backwards : {false, true}) {
    Curve curve = fillet_of(17, 0.2, 1.0);
    if (backwards) std::swap(curve.begin, curve.end);
    const CurveSpline spline(curve);
    const Point2 middle = point_at(curve, 0.5 * (curve.begin + curve.end));
    int compared = 0;
    for (int i = 0; i < 100; ++i) {
      const Point2 q = middle + 0.01 * (i + 1) * unit_vector(2.399963 * i);
      double nearest = 1e9;
      int at = 0;
      constexpr int kSamples = 5000;
      for (int k = 0; k <= kSamples; ++k) {
        const Point2 p = point_at(curve, curve.begin + (curve.end - curve.begin) * k / kSamples);
        if ((p - q).norm() < nearest) nearest = (p - q).norm(), at = k;
      }
      if (at == 0 || at == kSamples) continue;
      const auto foot = spline.foot(q, 1e9);
      ASSERT_TRUE(foot) << i;
      EXPECT_LE(foot->distance_mm, nearest + 1e-9) << i;
      // the foot lies within half a step of the sample
      EXPECT_NEAR(std::pow(foot->distance_mm, 2), nearest * nearest, 1e-7) << i;
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

TEST(CurveSpline, BeyondAnEndOrTheLimitThereIsNoFoot) {
  const Curve curve = fillet_of(20, 0.0, 1.0);
  const CurveSpline spline(curve);
  const Point2 before = curve.start_point() - 0.1 * tangent_at(curve, curve.begin);
  EXPECT_FALSE(spline.foot(before, 1e9));
  const double middle = 0.5 * (curve.begin + curve.end);
  const Point2 off = point_at(curve, middle) + 0.02 * perpendicular(tangent_at(curve, middle));
  EXPECT_TRUE(spline.foot(off, 0.03));
  EXPECT_FALSE(spline.foot(off, 0.01));
}

}  // namespace
}  // namespace trueflank
