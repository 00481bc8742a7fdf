// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/spline_basis.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank {
namespace {

constexpr int kLowestDegree = 3, kSplineDegree = 7;
constexpr int kMostEqualSpans = 8, kMostSpans = 64;
constexpr int kSamplesPerSpan = 24;

/// Largest error on each span, of interpolating every line.
std::vector<double> interpolation_errors(const LineBundle& lines, const SplineBasis& basis) {
  const auto& places = basis.places();
  Eigen::MatrixXd values;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::RowVectorXd row = lines(places[i]);
    if (i == 0) values.resize(basis.count(), row.size());
    values.row(static_cast<Eigen::Index>(i)) = row;
  }
  const Eigen::MatrixXd poles = SquareSolver(basis.collocation()).solve_columns(values);
  std::vector<double> errors;
  for (std::size_t i = 0; i + 1 < basis.knots().size(); ++i) {
    const double from = basis.knots()[i], to = basis.knots()[i + 1];
    double worst = 0.0;
    for (int k = 0; k < kSamplesPerSpan; ++k) {
      const double u = from + (to - from) * (k + 0.5) / kSamplesPerSpan;
      const BasisWeights w = basis.at(u);
      Eigen::RowVectorXd off = -lines(u);
      for (int j = 0; j <= basis.degree(); ++j)
        off += w.weight[static_cast<std::size_t>(j)] * poles.row(w.first + j);
      for (Eigen::Index line = 0; line < off.size(); line += 3)
        worst = std::max(worst, off.segment<3>(line).norm());
    }
    errors.push_back(worst);
  }
  return errors;
}

}  // namespace

SplineBasis::SplineBasis(int degree, std::vector<double> knots)
    : degree_(degree), knots_(std::move(knots)) {
  TRUEFLANK_EXPECTS(degree >= 1 && degree <= kHighestSplineDegree && knots_.size() >= 2);
  TRUEFLANK_EXPECTS(knots_.front() == 0.0 && knots_.back() == 1.0);
  multiplicities_.assign(knots_.size(), 1);
  multiplicities_.front() = multiplicities_.back() = degree + 1;
  for (std::size_t i = 0; i < knots_.size(); ++i)
    flat_.insert(flat_.end(), static_cast<std::size_t>(multiplicities_[i]), knots_[i]);
  const int n = count();
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 1; j <= degree; ++j) sum += flat_[static_cast<std::size_t>(i + j)];
    places_.push_back(n == degree + 1 ? 0.5 - 0.5 * std::cos(kPi * i / degree) : sum / degree);
  }
  places_.front() = 0.0;
  places_.back() = 1.0;
}

BasisWeights SplineBasis::at(double u) const {
  const auto last = flat_.end() - degree_ - 1;
  const auto above = std::upper_bound(flat_.begin() + degree_, last, u);
  const int span = static_cast<int>(std::min(above, last) - flat_.begin()) - 1;
  BasisWeights w{.first = span - degree_};
  w.weight[0] = 1.0;
  for (int k = 1; k <= degree_; ++k) {  // Cox, de Boor
    double carry = 0.0;
    for (int j = 0; j < k; ++j) {
      const double right = flat_[static_cast<std::size_t>(span + j + 1)];
      const double left = flat_[static_cast<std::size_t>(span + j + 1 - k)];
      const double share = w.weight[static_cast<std::size_t>(j)] / (right - left);
      w.weight[static_cast<std::size_t>(j)] = carry + (right - u) * share;
      carry = (u - left) * share;
    }
    w.weight[static_cast<std::size_t>(k)] = carry;
  }
  return w;
}

Eigen::MatrixXd SplineBasis::collocation() const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count(), count());
  for (int i = 0; i < count(); ++i) {
    const BasisWeights w = at(places_[static_cast<std::size_t>(i)]);
    for (int j = 0; j <= degree_; ++j)
      matrix(i, w.first + j) = w.weight[static_cast<std::size_t>(j)];
  }
  return matrix;
}

BasisFit fit_basis(const LineBundle& lines, double tolerance_mm) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  BasisFit best{SplineBasis(kLowestDegree, {0.0, 1.0}), kNaN};
  const auto keep = [&](SplineBasis basis, const std::vector<double>& errors) {
    const double error = *std::max_element(errors.begin(), errors.end());
    if (!(error >= best.error_mm)) best = {std::move(basis), error};
    return best.error_mm <= tolerance_mm;
  };
  for (int degree = kLowestDegree; degree <= kHighestSplineDegree; ++degree) {
    SplineBasis basis(degree, {0.0, 1.0});
    const auto errors = interpolation_errors(lines, basis);
    if (keep(std::move(basis), errors)) return best;
  }
  std::vector<double> knots{0.0, 0.5, 1.0};
  while (static_cast<int>(knots.size()) <= kMostSpans + 1) {
    SplineBasis basis(kSplineDegree, knots);
    const auto errors = interpolation_errors(lines, basis);
    if (keep(std::move(basis), errors)) return best;
    knots = next_spans(knots, errors, tolerance_mm);
  }
  return best;
}

std::vector<double> equal_spans(int count) {
  std::vector<double> knots;
  for (int i = 0; i <= count; ++i) knots.push_back(static_cast<double>(i) / count);
  return knots;
}

std::vector<double> halved_spans(const std::vector<double>& knots,
                                 const std::vector<double>& errors, double tolerance_mm) {
  std::vector<double> finer{knots.front()};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] > tolerance_mm) finer.push_back(0.5 * (knots[i] + knots[i + 1]));
    finer.push_back(knots[i + 1]);
  }
  return finer;
}

std::vector<double> next_spans(const std::vector<double>& knots, const std::vector<double>& errors,
                               double tolerance_mm) {
  const int spans = static_cast<int>(knots.size()) - 1;
  return spans < kMostEqualSpans ? equal_spans(spans + 1)
                                 : halved_spans(knots, errors, tolerance_mm);
}

}  // namespace trueflank
