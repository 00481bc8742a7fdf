// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/curve.h"
#include "trueflank/geometry/spline_basis.h"

// Polynomial splines that stand for a profile's curves where a format knows no involute.
namespace trueflank {

/// Clamped polynomial B-spline curve; one span is a Bezier curve. Smooth: interior knots are simple,
/// so all derivatives but the highest are continuous.
struct PlaneSpline {
  int degree = 1;
  std::vector<Point2> poles;
  std::vector<double> knots;        ///< distinct, rising; the ends have multiplicity degree + 1
  std::vector<int> multiplicities;  ///< one a knot

  [[nodiscard]] int spans() const { return static_cast<int>(knots.size()) - 1; }
};

/// Requires: knots.front() <= parameter <= knots.back().
[[nodiscard]] Point2 point_at(const PlaneSpline& spline, double parameter);
/// The same for many points: with the basis of the spline's degree and knots.
[[nodiscard]] Point2 point_at(const PlaneSpline& spline, const SplineBasis& basis, double parameter);

/// The curve's own parameter at a share of the way from begin (0) to end (1), in steps in which the
/// curve is smoothest: linear in roll angle for an involute, in a stretched angle for a trochoid.
/// A fit over this share converges fastest.
[[nodiscard]] double fit_parameter_at(const Curve& curve, double share);

struct BezierFit {
  PlaneSpline spline;     ///< knots run from 0 (the curve's begin) to 1 (its end)
  double error_mm = 0.0;  ///< largest distance of points of equal parameter, both ways a bound
};

/// Fits a piece of the profile by one Bezier span of the lowest degree from 5 to 8 that stays within
/// the tolerance, or by one smooth spline of degree 7 with as few spans as bisection finds. Ends are
/// exact. Interpolates in the curve's own parameter (for an involute the roll angle), in which the
/// curve is analytic; that is worth four digits over a fit in arc length.
/// Requires: tolerance_mm > 0. Guarantees: error_mm <= tolerance_mm for every piece of a profile at
/// 1e-8 mm; error_mm says what was achieved. Accuracy: the error is measured at 40 places a span.
[[nodiscard]] BezierFit fit_bezier(const Curve& curve, double tolerance_mm);

}  // namespace trueflank
