// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/discovery.h"

// Solving for many columns at once: the same sums for each of a panel of columns, which the
// compiler does several at a time. Every column is computed as if it stood alone.
namespace trueflank::loop {

/// Columns that are worked on at once, and how many of them the innermost loop takes.
constexpr int kPanelColumns = 32, kPanelStep = 32;
static_assert(kPanelColumns % kPanelStep == 0);

/// One row of a panel; columns that are not used are 0.
using PanelRow = std::array<double, kPanelColumns>;
/// As many rows as a model has columns.
using Panel = std::vector<PanelRow>;

/// Neighbouring columns of a panel: whole groups, all of them local ones or none.
struct PanelColumns {
  int first_group = 0, groups = 0, first_column = 0, columns = 0;
  bool operator==(const PanelColumns&) const = default;
};
/// The columns of groups that stand beside each other, in order.
[[nodiscard]] std::vector<PanelColumns> panels_of(const std::vector<CandidateGroup>& groups);

/// @name Sums, eight columns at a time
/// The same digits on every processor: wider registers add the same numbers in the same order.
/// @{
/// row += sum of factors[k] * others[k], in the order of k, and another row with factors of its own; the others
/// stand wherever they do.
void add_rows(PanelRow& row, const double* factors, PanelRow& other_row, const double* other_factors,
              const PanelRow* const* others, std::size_t count);
/// row -= sum of factors[k] * others[k], in the order of k.
void subtract_rows(PanelRow& row, const double* factors, const PanelRow* others, std::size_t count);
/// sums[d][j] += factor * row[j] * row[j + d]: products of columns that stand d apart.
void add_products(std::vector<PanelRow>& sums, double factor, const PanelRow& row);
/// sums[d][j] -= row[j] * other[j + d].
void subtract_products(std::vector<PanelRow>& sums, const PanelRow& row, const PanelRow& other);
/// sums[d][j] += row[j] * other[j + d] + other[j] * row[j + d] + square * row[j] * row[j + d], of so many sums.
void add_mixed_products(PanelRow* sums, std::size_t count, const PanelRow& row, const PanelRow& other,
                        double square);
/// @}

/// The inverse of a positive semidefinite matrix P^T L D L^T P, for panels.
class PanelSolver {
 public:
  PanelSolver() = default;
  explicit PanelSolver(const SymmetricSolver& solver);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// The row of the matrix that stands at a place of a panel: a row of P.
  [[nodiscard]] std::size_t row_at(std::size_t place) const { return rows_[place]; }
  /// 1 / D; 0 where that is nothing.
  [[nodiscard]] double inverse_pivot(std::size_t place) const { return inverse_pivots_[place]; }
  /// Rows in the order of places become L^-1 times them.
  void solve_lower(Panel& panel) const;
  /// The same with L^-T D^-1.
  void solve_upper(Panel& panel) const;

 private:
  std::vector<std::size_t> rows_;
  Eigen::MatrixXd lower_, upper_;  ///< L^T and L: factors of one row stand beside each other
  std::vector<double> inverse_pivots_;
};

}  // namespace trueflank::loop
