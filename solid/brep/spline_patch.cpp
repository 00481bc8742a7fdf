// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/spline_patch.h"

#include <algorithm>

namespace trueflank {
namespace {

constexpr int kProbesPerSpan = 7;

/// Probes inside the spans of a basis, none at a knot.
std::vector<double> probes(const SplineBasis& basis) {
  std::vector<double> at;
  for (std::size_t i = 0; i + 1 < basis.knots().size(); ++i)
    for (int k = 0; k < kProbesPerSpan; ++k)
      at.push_back(basis.knots()[i] + (basis.knots()[i + 1] - basis.knots()[i]) *
                                          (k + 0.5) / kProbesPerSpan);
  return at;
}

}  // namespace

std::vector<Point3> interpolated_curve(const SplineInterpolation& u,
                                       const std::function<Point3(double)>& point) {
  Eigen::MatrixXd values(u.count(), 3);
  for (int i = 0; i < u.count(); ++i)
    values.row(i) = point(u.basis().places()[static_cast<std::size_t>(i)]).transpose();
  const Eigen::MatrixXd solved = u.poles(values);
  std::vector<Point3> poles;
  for (int i = 0; i < u.count(); ++i) poles.emplace_back(solved.row(i).transpose());
  return poles;
}

std::vector<Point3> interpolated_patch(const SplineInterpolation& u, const SplineInterpolation& v,
                                       const std::function<Point3(double, double)>& point) {
  const int nu = u.count(), nv = v.count();
  Eigen::MatrixXd values(nu, 3 * nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      values.block<1, 3>(i, 3 * j) = point(u.basis().places()[static_cast<std::size_t>(i)],
                                           v.basis().places()[static_cast<std::size_t>(j)])
                                         .transpose();
  const Eigen::MatrixXd across = u.poles(values);  // poles over u, values over v
  Eigen::MatrixXd along(nv, 3 * nu);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) along.block<1, 3>(j, 3 * i) = across.block<1, 3>(i, 3 * j);
  const Eigen::MatrixXd solved = v.poles(along);
  std::vector<Point3> poles;
  poles.reserve(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv));
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) poles.emplace_back(solved.block<1, 3>(j, 3 * i).transpose());
  return poles;
}

Point3 patch_point(const SplineBasis& u, const SplineBasis& v, const std::vector<Point3>& poles,
                   double at_u, double at_v) {
  const BasisWeights wu = u.at(at_u), wv = v.at(at_v);
  Point3 sum = Point3::Zero();
  for (int i = 0; i <= u.degree(); ++i) {
    Point3 row = Point3::Zero();
    for (int j = 0; j <= v.degree(); ++j)
      row += wv.weight[static_cast<std::size_t>(j)] *
             poles[static_cast<std::size_t>((wu.first + i) * v.count() + wv.first + j)];
    sum += wu.weight[static_cast<std::size_t>(i)] * row;
  }
  return sum;
}

double patch_error_mm(const SplineBasis& u, const SplineBasis& v, const std::vector<Point3>& poles,
                      const std::function<Point3(double, double)>& point) {
  double worst = 0.0;
  for (const double at_u : probes(u))
    for (const double at_v : probes(v))
      worst = std::max(worst, (patch_point(u, v, poles, at_u, at_v) - point(at_u, at_v)).norm());
  return worst;
}

SplineCurve spline_curve(const SplineBasis& u, std::vector<Point3> poles) {
  return {.degree = u.degree(), .poles = std::move(poles), .knots = u.knots(),
          .multiplicities = u.multiplicities()};
}

SplineSurface spline_surface(const SplineBasis& u, const SplineBasis& v,
                             std::vector<Point3> poles) {
  return {.degree_u = u.degree(), .degree_v = v.degree(), .count_v = v.count(),
          .poles = std::move(poles), .knots_u = u.knots(), .knots_v = v.knots(),
          .multiplicities_u = u.multiplicities(), .multiplicities_v = v.multiplicities()};
}

}  // namespace trueflank
