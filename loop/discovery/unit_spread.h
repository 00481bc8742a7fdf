// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "trueflank/loop/discovery/column_panels.h"

namespace trueflank::loop {

/// What the fitted columns take from the spread of candidates in one unit (a trace, a patch).
///
/// Beside a fit with the Gram matrix G (M x M, all units) a candidate with the coefficients A on the
/// fitted columns has in this unit the products O = C - B A with them, B being the unit's own Gram
/// matrix and C its products of fitted columns and candidate. The fit takes O^T G^-1 O of it. Few
/// of the fitted columns differ within one unit (on a trace a wave over the teeth is a constant), so
/// that B has a low rank r: C is known from r of its rows, and r rows are all that is worked on.
class UnitSpread {
 public:
  /// `gram` is B, `inverse` G^-1. A direction of B with less than 1e-13 of a column's own square in
  /// this unit is left out: no digit that a probability shows depends on it.
  UnitSpread(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& inverse);

  [[nodiscard]] std::size_t rank() const { return rows_.size(); }
  /// The rows of C that are needed, as many as the rank.
  [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }
  /// Rows whose squares add up to O^T G^-1 O; `own` are where the rows of C asked for by rows() stand,
  /// `absorbed` those of A. As many as the rank are written into `spread`, which must have room for them.
  void spread_of(const PanelRow* const* own, const Panel& absorbed, Panel& spread) const;

 private:
  std::vector<std::size_t> rows_;
  Eigen::MatrixXd of_own_;       ///< r x r: a column for each row of the result
  Eigen::MatrixXd of_absorbed_;  ///< M x r
};

}  // namespace trueflank::loop
