// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/linear_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace trueflank {

struct SymmetricSolver::Factors {
  explicit Factors(const Eigen::MatrixXd& a) : ldlt(a), swaps(ldlt.transpositionsP().indices()) {}
  Eigen::LDLT<Eigen::MatrixXd> ldlt;
  Eigen::VectorXi swaps;
};

SymmetricSolver::SymmetricSolver(const Eigen::MatrixXd& a)
    : factors_(std::make_shared<const Factors>(a)) {}

bool SymmetricSolver::is_positive() const {
  return factors_->ldlt.info() == Eigen::Success && factors_->ldlt.isPositive();
}

Eigen::VectorXd SymmetricSolver::solve(const Eigen::VectorXd& b) const {
  return factors_->ldlt.solve(b);
}

Eigen::MatrixXd SymmetricSolver::solve_columns(const Eigen::MatrixXd& b) const {
  return factors_->ldlt.solve(b);
}

const Eigen::MatrixXd& SymmetricSolver::factors() const { return factors_->ldlt.matrixLDLT(); }

const Eigen::VectorXi& SymmetricSolver::swaps() const { return factors_->swaps; }

Eigen::VectorXd symmetric_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return Eigen::LDLT<Eigen::MatrixXd>(a).solve(b);
}

struct SquareSolver::Factors {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

SquareSolver::SquareSolver(const Eigen::MatrixXd& a)
    : factors_(std::make_shared<const Factors>(Factors{Eigen::PartialPivLU<Eigen::MatrixXd>(a)})) {}

Eigen::MatrixXd SquareSolver::solve_columns(const Eigen::MatrixXd& b) const {
  return factors_->lu.solve(b);
}

double determinant_of(const Eigen::MatrixXd& a) { return a.determinant(); }

std::optional<Eigen::VectorXd> solution_if_regular(const Eigen::MatrixXd& a,
                                                   const Eigen::VectorXd& b) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
  if (!lu.isInvertible()) return std::nullopt;
  return lu.solve(b);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& a) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ() *
         Eigen::MatrixXd::Identity(a.rows(), a.cols());
}

}  // namespace trueflank
