// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/bezier_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr int kLowestDegree = 5, kHighestDegree = 8, kSplineDegree = 7;
constexpr int kMostEqualSpans = 8, kMostSpans = 64;
constexpr int kSamplesPerSpan = 40;

/// All knots with their multiplicities written out.
std::vector<double> flat_knots(const PlaneSpline& s) {
  std::vector<double> flat;
  for (std::size_t i = 0; i < s.knots.size(); ++i)
    flat.insert(flat.end(), static_cast<std::size_t>(s.multiplicities[i]), s.knots[i]);
  return flat;
}

int span_of(const std::vector<double>& flat, int degree, double u) {
  const auto last = flat.end() - degree - 1;
  const auto above = std::upper_bound(flat.begin() + degree, last, u);
  return static_cast<int>(std::min(above, last) - flat.begin()) - 1;
}

/// The degree + 1 basis functions that do not vanish on a span (Cox, de Boor).
std::array<double, kHighestDegree + 1> basis(const std::vector<double>& flat, int degree, int span,
                                             double u) {
  std::array<double, kHighestDegree + 1> value{};
  value[0] = 1.0;
  for (int k = 1; k <= degree; ++k) {
    double carry = 0.0;
    for (int j = 0; j < k; ++j) {
      const double right = flat[static_cast<std::size_t>(span + j + 1)];
      const double left = flat[static_cast<std::size_t>(span + j + 1 - k)];
      const double share = value[static_cast<std::size_t>(j)] / (right - left);
      value[static_cast<std::size_t>(j)] = carry + (right - u) * share;
      carry = (u - left) * share;
    }
    value[static_cast<std::size_t>(k)] = carry;
  }
  return value;
}

Point2 spline_point(const PlaneSpline& s, const std::vector<double>& flat, double u) {
  const int span = span_of(flat, s.degree, u);
  const auto weight = basis(flat, s.degree, span, u);
  Point2 sum = Point2::Zero();
  for (int j = 0; j <= s.degree; ++j)
    sum += weight[static_cast<std::size_t>(j)] *
           s.poles[static_cast<std::size_t>(span - s.degree + j)];
  return sum;
}

/// Lobatto points for one span (near the best polynomial), Greville points for several (always
/// solvable).
std::vector<double> interpolation_places(const std::vector<double>& flat, int degree, int count) {
  std::vector<double> places(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int j = 1; j <= degree; ++j) sum += flat[static_cast<std::size_t>(i + j)];
    places[static_cast<std::size_t>(i)] =
        count == degree + 1 ? 0.5 - 0.5 * std::cos(kPi * i / degree) : sum / degree;
  }
  places.front() = 0.0;
  places.back() = 1.0;
  return places;
}

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

double curve_parameter(const CircularArc&, double v) { return v; }
double curve_parameter(const StraightLine&, double v) { return v; }
double curve_parameter(const Involute&, double v) { return v; }
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
  const double parameter = std::visit(
      [&](const auto& shape) {
        const double from = fit_parameter(shape, c.begin), to = fit_parameter(shape, c.end);
        return curve_parameter(shape, from + u * (to - from));
      },
      c.shape);
  return point_at(c, parameter);
}

/// Interpolates the curve with the given distinct knots.
PlaneSpline interpolate(const Curve& curve, int degree, std::vector<double> knots) {
  PlaneSpline s{.degree = degree, .poles = {}, .knots = std::move(knots), .multiplicities = {}};
  s.multiplicities.assign(s.knots.size(), 1);
  s.multiplicities.front() = s.multiplicities.back() = degree + 1;
  const auto flat = flat_knots(s);
  const int count = static_cast<int>(flat.size()) - degree - 1;
  const auto places = interpolation_places(flat, degree, count);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixX2d points(count, 2);
  for (int i = 0; i < count; ++i) {
    const double u = places[static_cast<std::size_t>(i)];
    const int span = span_of(flat, degree, u);
    const auto weight = basis(flat, degree, span, u);
    for (int j = 0; j <= degree; ++j)
      matrix(i, span - degree + j) = weight[static_cast<std::size_t>(j)];
    points.row(i) = curve_point(curve, u).transpose();
  }
  const Eigen::MatrixX2d poles = matrix.partialPivLu().solve(points);
  for (int i = 0; i < count; ++i) s.poles.emplace_back(poles.row(i).transpose());
  s.poles.front() = curve_point(curve, 0.0);
  s.poles.back() = curve_point(curve, 1.0);
  return s;
}

/// Largest error on each span.
std::vector<double> span_errors(const Curve& curve, const PlaneSpline& s) {
  const auto flat = flat_knots(s);
  std::vector<double> errors;
  for (int i = 0; i < s.spans(); ++i) {
    const double from = s.knots[static_cast<std::size_t>(i)];
    const double to = s.knots[static_cast<std::size_t>(i) + 1];
    double worst = 0.0;
    for (int k = 0; k < kSamplesPerSpan; ++k) {
      const double u = from + (to - from) * (k + 0.5) / kSamplesPerSpan;
      worst = std::max(worst, (spline_point(s, flat, u) - curve_point(curve, u)).norm());
    }
    errors.push_back(worst);
  }
  return errors;
}

std::vector<double> equal_spans(int count) {
  std::vector<double> knots;
  for (int i = 0; i <= count; ++i) knots.push_back(static_cast<double>(i) / count);
  return knots;
}

/// Halves the spans that miss the tolerance.
std::vector<double> refined(const std::vector<double>& knots, const std::vector<double>& errors,
                            double tolerance_mm) {
  std::vector<double> finer{knots.front()};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] > tolerance_mm) finer.push_back(0.5 * (knots[i] + knots[i + 1]));
    finer.push_back(knots[i + 1]);
  }
  return finer;
}

}  // namespace

Point2 point_at(const PlaneSpline& spline, double parameter) {
  TRUEFLANK_EXPECTS(spline.degree >= 1 && spline.degree <= kHighestDegree);
  return spline_point(spline, flat_knots(spline), parameter);
}

BezierFit fit_bezier(const Curve& curve, double tolerance_mm) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  BezierFit best{.spline = {}, .error_mm = kNaN};
  const auto keep = [&](PlaneSpline spline, const std::vector<double>& errors) {
    const double error = *std::max_element(errors.begin(), errors.end());
    if (!(error >= best.error_mm)) best = {std::move(spline), error};
    return best.error_mm <= tolerance_mm;
  };
  for (int degree = kLowestDegree; degree <= kHighestDegree; ++degree) {
    PlaneSpline spline = interpolate(curve, degree, {0.0, 1.0});
    const auto errors = span_errors(curve, spline);
    if (keep(std::move(spline), errors)) return best;
  }
  std::vector<double> knots{0.0, 0.5, 1.0};
  while (static_cast<int>(knots.size()) <= kMostSpans + 1) {
    PlaneSpline spline = interpolate(curve, kSplineDegree, knots);
    const auto errors = span_errors(curve, spline);
    if (keep(std::move(spline), errors)) return best;
    const int spans = static_cast<int>(knots.size()) - 1;
    knots = spans < kMostEqualSpans ? equal_spans(spans + 1) : refined(knots, errors, tolerance_mm);
  }
  return best;
}

}  // namespace trueflank
