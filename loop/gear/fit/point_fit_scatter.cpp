// SPDX-License-Identifier: GPL-3.0-or-later
// How well the coefficients of a fit are known: by how much units of the data differ from each
// other.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/fit/point_fit.h"

namespace trueflank::loop {

/// Whether the scatter between units says nothing of a column: few carry it, or sizes alone, whose
/// own error is known and whose scatter is too small a sample. Sets its degrees of freedom.
bool PointFit::few_units_bear(int k) {
  double sum = 0.0, squares = 0.0;
  for (const Eigen::MatrixXd& unit : unit_grams_) {
    if (unit.size() == 0) continue;
    sum += unit(k, k);
    squares += unit(k, k) * unit(k, k);
  }
  const double bearing = squares > 0.0 ? sum * sum / squares : 1.0;
  degrees_[k] = std::max(1.0, bearing - 1.0);
  const double threshold = 1e-6 * sum;
  bool sizes_only = sum > 0.0;
  for (std::size_t b = 0; b < unit_grams_.size(); ++b)
    sizes_only = sizes_only && (unit_grams_[b].size() == 0 || unit_grams_[b](k, k) <= threshold ||
                                unit_kind_[b] == static_cast<int>(ObservationKind::kSize));
  return bearing < 2.6 || sizes_only;
}

/// The weight of each trace's zero, and the variance of a value of weight 1 as the pieces' means
/// show it, by the kind of record: what the pieces' share in their zero took out of their sums.
struct PointFit::ZerosOfPieces {
  std::map<int, double> weight, pieces;
  std::map<int, double> variance;

  explicit ZerosOfPieces(const PointFit& fit) {
    const int p = fit.columns_;
    for (std::size_t u = 0; u < fit.unit_grams_.size(); ++u) {
      if (fit.unit_grams_[u].size() == 0 || fit.unit_zero_[u] < 0) continue;
      weight[fit.unit_zero_[u]] += fit.unit_sums_[u][p + 1];
      pieces[fit.unit_zero_[u]] += 1.0;
    }
    std::map<int, double> squares, degrees;
    for (std::size_t u = 0; u < fit.unit_grams_.size(); ++u) {
      if (fit.unit_grams_[u].size() == 0 || fit.unit_zero_[u] < 0) continue;
      const double left = fit.unit_sums_[u][p] - fit.coefficients_.dot(fit.unit_sums_[u].head(p));
      const double count = pieces[fit.unit_zero_[u]];
      squares[fit.unit_kind_[u]] += left * left / fit.unit_sums_[u][p + 1];
      degrees[fit.unit_kind_[u]] += 1.0 - 1.0 / count;
    }
    for (const auto& [kind, square] : squares)
      variance[kind] = degrees[kind] > 0.5 ? square / degrees[kind] : 0.0;
  }
};

/// Leave-one-unit-out: (I - H_b)^-1 of the classical jackknife in the form of normal equations.
/// Pieces of one trace share its zero: their residuals are smaller than their errors by that, and
/// what it takes out of a slope along the trace is put back.
void PointFit::spread_between_units(const Eigen::MatrixXd& normal) {
  const int p = columns_;
  double used = 0.0;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
  ZerosOfPieces zeros(*this);
  for (std::size_t u = 0; u < unit_grams_.size(); ++u) {
    const Eigen::MatrixXd& unit = unit_grams_[u];
    if (unit.size() == 0) continue;
    const Eigen::MatrixXd rest = normal - unit.topLeftCorner(p, p);
    const bool is_piece = unit_zero_[u] >= 0 && zeros.pieces[unit_zero_[u]] > 1.5;
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(p, is_piece ? 2 : 1);
    scores.col(0) = unit.col(p).head(p) - unit.topLeftCorner(p, p) * coefficients_;
    if (is_piece)
      scores.col(1) = unit_sums_[u].head(p) *
                      std::sqrt(zeros.variance[unit_kind_[u]] / zeros.weight[unit_zero_[u]]);
    Eigen::MatrixXd safe = rest;
    for (int k = 0; k < p; ++k)
      if (!(rest(k, k) > 1e-6 * normal(k, k))) {
        safe.row(k).setZero();
        safe.col(k).setZero();
        safe(k, k) = 1.0;
        scores.row(k).setZero();
      }
    for (Eigen::Index k = 0; k < scores.cols(); ++k) {
      const Eigen::VectorXd score = scores.col(k);
      const Eigen::VectorXd change = symmetric_solution(safe, score);
      sum += change * change.transpose();
    }
    used += 1.0;
  }
  covariance_ = sum * ((used - 1.0) / std::max(1.0, used));
}

/// Of a column that few units bear: how far the means of the other units scatter, against what
/// their weights promise.
void PointFit::spread_beside(int k, double normal, double inverse) {
  // (of values on one zero each has a little of every column)
  constexpr double kBears = 0.02;
  const int p = columns_;
  double scatter = 0.0, count = 0.0;
  std::set<int> kinds;
  for (std::size_t b = 0; b < unit_grams_.size(); ++b)
    if (unit_grams_[b].size() > 0 && unit_grams_[b](k, k) > kBears * normal &&
        unit_kind_[b] != static_cast<int>(ObservationKind::kProfile) &&
        unit_kind_[b] != static_cast<int>(ObservationKind::kHelix))
      kinds.insert(unit_kind_[b]);
  for (std::size_t b = 0; b < unit_grams_.size(); ++b) {
    if (unit_grams_[b].size() == 0 || unit_grams_[b](k, k) > kBears * normal) continue;
    if (!kinds.contains(unit_kind_[b])) continue;
    const double sum_b = unit_sums_[b][p] - coefficients_.dot(unit_sums_[b].head(p));
    scatter += sum_b * sum_b / unit_sums_[b][p + 1];
    count += 1.0;
  }
  covariance_.row(k).setZero();
  covariance_.col(k).setZero();
  // Sizes come with their own error, and are too few to tell a smaller one.
  const bool sizes_only =
      kinds.size() == 1 && kinds.contains(static_cast<int>(ObservationKind::kSize));
  const double scale = count > 0.0 ? scatter / count : 1.0;
  covariance_(k, k) = inverse * (sizes_only ? std::max(1.0, scale) : scale);
  const bool by_scatter = sizes_only && table_.size_degrees > 0;
  degrees_[k] = by_scatter ? table_.size_degrees : std::max(4.0, count - 1.0);
}

}  // namespace trueflank::loop
