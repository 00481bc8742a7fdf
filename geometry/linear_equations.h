// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

// Eigen's decompositions of matrices of any size behind plain functions: their templates are
// compiled once, not in every source that solves equations. To the last bit what Eigen's own calls
// give, whose names stand beside them.
namespace trueflank {

/// A x = b for many b, A symmetric and positive semidefinite; only its lower half is read.
/// Eigen::LDLT.
class SymmetricSolver {
 public:
  explicit SymmetricSolver(const Eigen::MatrixXd& a);

  /// False where A has a negative pivot, or none that is finite.
  [[nodiscard]] bool is_positive() const;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// The same for each column.
  [[nodiscard]] Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& b) const;

  /// @name The factors of A = P^T L D L^T P
  /// @{
  [[nodiscard]] const Eigen::MatrixXd& factors() const;  ///< L below the diagonal, D on it
  /// P exchanges row i with row swaps[i], the first i first.
  [[nodiscard]] const Eigen::VectorXi& swaps() const;
  /// @}

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// A x = b for one b, A as SymmetricSolver has it.
[[nodiscard]] Eigen::VectorXd symmetric_solution(const Eigen::MatrixXd& a,
                                                 const Eigen::VectorXd& b);

/// A x = b for many b, A square and regular. Eigen::PartialPivLU.
class SquareSolver {
 public:
  explicit SquareSolver(const Eigen::MatrixXd& a);
  [[nodiscard]] Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& b) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// Of a square matrix. Eigen::PartialPivLU.
[[nodiscard]] double determinant_of(const Eigen::MatrixXd& a);

/// A x = b, A square; nothing where A is singular. Eigen::FullPivLU.
[[nodiscard]] std::optional<Eigen::VectorXd> solution_if_regular(const Eigen::MatrixXd& a,
                                                                 const Eigen::VectorXd& b);

/// The x with the least |A x - b|; of columns that depend on each other some stay 0.
/// Eigen::ColPivHouseholderQR.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// An orthonormal basis of the columns of a matrix with no fewer rows, in their order.
/// Eigen::HouseholderQR.
[[nodiscard]] Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& a);

}  // namespace trueflank
