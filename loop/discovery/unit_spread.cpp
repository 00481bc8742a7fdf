// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/unit_spread.h"

#include <algorithm>
#include <cmath>

#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Of a column's own square in the unit: less is rounding.
constexpr double kNothingLeft = 1e-13;

/// R with `gram` = R^T R, a row for each of its independent columns, which `pivots` gets: the column
/// that keeps most of itself beside the earlier ones first.
Eigen::MatrixXd independent_rows(const Eigen::MatrixXd& gram, std::vector<std::size_t>& pivots) {
  const Eigen::Index m = gram.rows();
  const Eigen::VectorXd whole = gram.diagonal();
  Eigen::VectorXd left = whole;
  Eigen::MatrixXd rows(m, m);
  Eigen::Index rank = 0;
  for (; rank < m; ++rank) {
    Eigen::Index pivot = -1;
    double most = kNothingLeft;
    for (Eigen::Index i = 0; i < m; ++i)
      if (whole[i] > 0.0 && left[i] > most * whole[i]) {
        pivot = i;
        most = left[i] / whole[i];
      }
    if (pivot < 0) break;
    Eigen::RowVectorXd row = gram.row(pivot);
    for (Eigen::Index k = 0; k < rank; ++k) row -= rows(k, pivot) * rows.row(k);
    row /= std::sqrt(left[pivot]);
    left -= row.transpose().cwiseAbs2();
    left[pivot] = 0.0;
    rows.row(rank) = row;
    pivots.push_back(static_cast<std::size_t>(pivot));
  }
  return rows.topRows(rank);
}

/// N with a = N^T N, a symmetric and positive semidefinite but for rounding.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& a) {
  const SymmetricSolver solver(a);
  const PanelSolver places(solver);
  const Eigen::MatrixXd& factors = solver.factors();
  const Eigen::Index r = a.rows();
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(r, r);
  for (Eigen::Index k = 0; k < r; ++k) {
    const double pivot = std::sqrt(std::max(0.0, factors(k, k)));
    for (Eigen::Index j = k; j < r; ++j)
      root(k, static_cast<Eigen::Index>(places.row_at(static_cast<std::size_t>(j)))) =
          pivot * (j == k ? 1.0 : factors(j, k));
  }
  return root;
}

}  // namespace

UnitSpread::UnitSpread(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& inverse) {
  const Eigen::MatrixXd rows = independent_rows(gram, rows_);
  const auto r = static_cast<Eigen::Index>(rows_.size());
  if (r == 0) return;
  const Eigen::MatrixXd root = root_of(rows * inverse * rows.transpose());
  // own rows = U^T z, where U are the pivots' columns of R: the root is asked for z
  Eigen::MatrixXd of_own = root;
  for (Eigen::Index j = r; j-- > 0;) {
    const auto pivot = static_cast<Eigen::Index>(rows_[static_cast<std::size_t>(j)]);
    for (Eigen::Index t = j + 1; t < r; ++t)
      of_own.col(j) -=
          of_own.col(t) * rows(j, static_cast<Eigen::Index>(rows_[static_cast<std::size_t>(t)]));
    of_own.col(j) /= rows(j, pivot);
  }
  of_own_ = of_own.transpose();
  of_absorbed_ = (root * rows).transpose();
}

void UnitSpread::spread_of(const PanelRow* const* own, const Panel& absorbed, Panel& spread) const {
  for (std::size_t k = 0; k < rank(); ++k) {
    PanelRow& row = spread[k];
    row.fill(0.0);
    add_rows(row, of_own_.col(static_cast<Eigen::Index>(k)).data(), own, rank());
    subtract_rows(row, of_absorbed_.col(static_cast<Eigen::Index>(k)).data(), absorbed.data(),
                  absorbed.size());
  }
}

}  // namespace trueflank::loop
