// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/geometry/spline_basis.h"
#include "trueflank/solid/brep/brep.h"

// Spline curves and surfaces in space that pass through points of a true one.
namespace trueflank {

/// A basis ready to interpolate many curves.
class SplineInterpolation {
 public:
  explicit SplineInterpolation(SplineBasis basis)
      : basis_(std::move(basis)), collocation_(basis_.collocation()) {}

  [[nodiscard]] const SplineBasis& basis() const { return basis_; }
  [[nodiscard]] int count() const { return basis_.count(); }
  /// Values at basis().places(), one a row, to poles.
  [[nodiscard]] Eigen::MatrixXd poles(const Eigen::MatrixXd& values) const {
    return collocation_.solve_columns(values);
  }

 private:
  SplineBasis basis_;
  SquareSolver collocation_;
};

/// Poles of the curve through the points at the basis' places.
[[nodiscard]] std::vector<Point3> interpolated_curve(const SplineInterpolation& u,
                                                     const std::function<Point3(double)>& point);

/// Poles of the surface through the points at the places of both bases, as SplineSurface has them.
/// Guarantees: its boundaries are the interpolated curves of the boundaries, but for rounding.
[[nodiscard]] std::vector<Point3> interpolated_patch(
    const SplineInterpolation& u, const SplineInterpolation& v,
    const std::function<Point3(double, double)>& point);

[[nodiscard]] Point3 patch_point(const SplineBasis& u, const SplineBasis& v,
                                 const std::vector<Point3>& poles, double at_u, double at_v);

/// Largest distance of points of equal parameters, measured between the places of every span.
[[nodiscard]] double patch_error_mm(const SplineBasis& u, const SplineBasis& v,
                                    const std::vector<Point3>& poles,
                                    const std::function<Point3(double, double)>& point);

[[nodiscard]] SplineCurve spline_curve(const SplineBasis& u, std::vector<Point3> poles);
[[nodiscard]] SplineSurface spline_surface(const SplineBasis& u, const SplineBasis& v,
                                           std::vector<Point3> poles);

}  // namespace trueflank
