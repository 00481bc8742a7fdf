// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

// What spline curves and surfaces share: knots, basis functions, interpolation.
namespace trueflank {

constexpr int kHighestSplineDegree = 8;

/// The degree + 1 basis functions that do not vanish at a parameter, and the first of them.
struct BasisWeights {
  int first = 0;
  std::array<double, kHighestSplineDegree + 1> weight{};
};

/// Clamped B-spline basis over 0 .. 1; interior knots are simple, so all derivatives but the highest
/// are continuous.
class SplineBasis {
 public:
  /// Requires: 1 <= degree <= 8, knots rise from 0 to 1.
  SplineBasis(int degree, std::vector<double> knots);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int count() const { return static_cast<int>(flat_.size()) - degree_ - 1; }
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }  ///< distinct
  [[nodiscard]] const std::vector<int>& multiplicities() const { return multiplicities_; }
  [[nodiscard]] BasisWeights at(double u) const;

  /// Where values are asked for interpolation, one a pole: Lobatto points for one span (near the best
  /// polynomial), Greville points for several (always solvable). First 0, last 1.
  [[nodiscard]] const std::vector<double>& places() const { return places_; }
  /// The matrix that takes poles to values at places().
  [[nodiscard]] Eigen::MatrixXd collocation() const;

 private:
  int degree_;
  std::vector<double> knots_, flat_, places_;
  std::vector<int> multiplicities_;
};

/// Several curves over 0 .. 1 side by side: x, y, z of each [mm].
using LineBundle = std::function<Eigen::RowVectorXd(double u)>;

struct BasisFit {
  SplineBasis basis;
  double error_mm = 0.0;  ///< largest distance of points of equal parameter
};

/// The basis with the fewest poles found in which every line of a bundle is interpolated within the
/// tolerance: one span of degree 3 to 8, else degree 7 with equal and then halved spans. The nearest
/// one where 64 spans do not suffice; error_mm says so.
/// Accuracy: the error is measured at 24 places a span.
[[nodiscard]] BasisFit fit_basis(const LineBundle& lines, double tolerance_mm);

/// @name Knots of finer and finer bases
/// @{
[[nodiscard]] std::vector<double> equal_spans(int count);
/// Halves the spans whose error misses the tolerance.
[[nodiscard]] std::vector<double> halved_spans(const std::vector<double>& knots,
                                               const std::vector<double>& errors,
                                               double tolerance_mm);
/// After one span did not do: equal spans while they are few, then halved ones.
[[nodiscard]] std::vector<double> next_spans(const std::vector<double>& knots,
                                             const std::vector<double>& errors,
                                             double tolerance_mm);
/// @}

}  // namespace trueflank
