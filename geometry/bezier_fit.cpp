// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/bezier_fit.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank {
namespace {

constexpr int kLowestCurveDegree = 5, kCurveDegree = 7;
constexpr int kMostCurveSpans = 64;
constexpr int kSamplesPerCurveSpan = 40;

/// Requires: interior knots are simple, as fit_bezier() makes them.
SplineBasis basis_of(const PlaneSpline& s) { return {s.degree, s.knots}; }

/// gd(v) = atan(sinh v), and its inverse.
double gudermannian(double v) { return std::atan(std::sinh(v)); }
double inverse_gudermannian(double angle_rad) { return std::asinh(std::tan(angle_rad)); }

double corner_radius_ratio(const CutterTrochoid& c) {
  return c.corner_centre_radius_mm / c.cutter_pitch_radius_mm;
}
bool is_fillet(const CutterTrochoid& c) { return c.contact == CutterContact::kFillet; }

// The parameter v in which a curve is fitted. A trochoid holds cot t of its normal's angle: a pole
// close to the interval in t, and in the tool's travel a root. With sin t = 1 / cosh v, cot t =
// sinh v both are gone to |Im v| = pi/2, which saves two spans of three.
double fit_parameter(const CircularArc&, double t) { return t; }
double fit_parameter(const StraightLine&, double t) { return t; }
double fit_parameter(const Involute&, double t) { return t; }
double fit_parameter(const RackTrochoid&, double t) { return inverse_gudermannian(0.5 * kPi - t); }
double fit_parameter(const CutterTrochoid& c, double eta) {
  if (!is_fillet(c)) return eta;
  const double off = eta - c.corner_centre_angle_rad, ratio = corner_radius_ratio(c);
  if (ratio <= 1.0) return inverse_gudermannian(off);
  return inverse_gudermannian(std::asin(std::min(ratio * std::sin(off), 1.0)));
}
double fit_parameter(const PointCurve&, double t) { return t; }

double curve_parameter(const CircularArc&, double v) { return v; }
double curve_parameter(const StraightLine&, double v) { return v; }
double curve_parameter(const Involute&, double v) { return v; }
double curve_parameter(const PointCurve&, double v) { return v; }
double curve_parameter(const RackTrochoid&, double v) { return 0.5 * kPi - gudermannian(v); }
double curve_parameter(const CutterTrochoid& c, double v) {
  if (!is_fillet(c)) return v;
  const double ratio = corner_radius_ratio(c);
  const double off = ratio <= 1.0 ? gudermannian(v) : std::asin(std::tanh(v) / ratio);
  return off + c.corner_centre_angle_rad;
}

/// The curve over u = 0 .. 1, linear in the parameter of the fit; the ends to the last bit.
Point2 curve_point(const Curve& c, double u) {
  if (u == 0.0) return c.start_point();
  if (u == 1.0) return c.end_point();
  return point_at(c, fit_parameter_at(c, u));
}

/// Interpolates the curve with the given distinct knots.
PlaneSpline interpolate(const Curve& curve, int degree, std::vector<double> knots) {
  const SplineBasis basis(degree, std::move(knots));
  PlaneSpline s{.degree = degree, .poles = {}, .knots = basis.knots(),
                .multiplicities = basis.multiplicities()};
  const int count = basis.count();
  Eigen::MatrixX2d points(count, 2);
  for (int i = 0; i < count; ++i)
    points.row(i) = curve_point(curve, basis.places()[static_cast<std::size_t>(i)]).transpose();
  const Eigen::MatrixX2d poles = SquareSolver(basis.collocation()).solve_columns(points);
  for (int i = 0; i < count; ++i) s.poles.emplace_back(poles.row(i).transpose());
  s.poles.front() = curve_point(curve, 0.0);
  s.poles.back() = curve_point(curve, 1.0);
  return s;
}

/// Largest error on each span.
std::vector<double> span_errors(const Curve& curve, const PlaneSpline& s) {
  const SplineBasis basis = basis_of(s);
  std::vector<double> errors;
  for (int i = 0; i < s.spans(); ++i) {
    const double from = s.knots[static_cast<std::size_t>(i)];
    const double to = s.knots[static_cast<std::size_t>(i) + 1];
    double worst = 0.0;
    for (int k = 0; k < kSamplesPerCurveSpan; ++k) {
      const double u = from + (to - from) * (k + 0.5) / kSamplesPerCurveSpan;
      worst = std::max(worst, (point_at(s, basis, u) - curve_point(curve, u)).norm());
    }
    errors.push_back(worst);
  }
  return errors;
}

}  // namespace

Point2 point_at(const PlaneSpline& s, const SplineBasis& basis, double u) {
  const BasisWeights w = basis.at(u);
  Point2 sum = Point2::Zero();
  for (int j = 0; j <= s.degree; ++j)
    sum += w.weight[static_cast<std::size_t>(j)] *
           s.poles[static_cast<std::size_t>(w.first + j)];
  return sum;
}

Point2 point_at(const PlaneSpline& spline, double parameter) {
  return point_at(spline, basis_of(spline), parameter);
}

double fit_parameter_at(const Curve& curve, double share) {
  if (share == 0.0) return curve.begin;
  if (share == 1.0) return curve.end;
  return std::visit(
      [&](const auto& shape) {
        const double from = fit_parameter(shape, curve.begin), to = fit_parameter(shape, curve.end);
        return curve_parameter(shape, from + share * (to - from));
      },
      curve.shape);
}

BezierFit fit_bezier(const Curve& curve, double tolerance_mm) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  BezierFit best{.spline = {}, .error_mm = kNaN};
  const auto keep = [&](PlaneSpline spline, const std::vector<double>& errors) {
    const double error = *std::max_element(errors.begin(), errors.end());
    if (!(error >= best.error_mm)) best = {std::move(spline), error};
    return best.error_mm <= tolerance_mm;
  };
  for (int degree = kLowestCurveDegree; degree <= kHighestSplineDegree; ++degree) {
    PlaneSpline spline = interpolate(curve, degree, {0.0, 1.0});
    const auto errors = span_errors(curve, spline);
    if (keep(std::move(spline), errors)) return best;
  }
  std::vector<double> knots{0.0, 0.5, 1.0};
  while (static_cast<int>(knots.size()) <= kMostCurveSpans + 1) {
    PlaneSpline spline = interpolate(curve, kCurveDegree, knots);
    const auto errors = span_errors(curve, spline);
    if (keep(std::move(spline), errors)) return best;
    knots = next_spans(knots, errors, tolerance_mm);
  }
  return best;
}

}  // namespace trueflank
