// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/block_statistics.h"
#include "trueflank/loop/discovery/cross_validation.h"

namespace trueflank::loop {

/// The errors of CrossValidation for a model less some of its columns and with one group more: to some
/// ten digits, as all of them follow from one inverse of the whole model. It tells which of many
/// exchanges are worth an exact answer.
///
/// With the inverse V of the model's Gram matrix, columns S left out, D = V_S (V_SS)^-1: coefficients
/// b become b - D b_S, and so do those of a candidate on the model. What that changes of an error follows from
/// the rows S of two matrices of the candidates: no sum over the model for each exchange.
class QuickErrors {
 public:
  /// Of groups that may be asked for; others are not.
  QuickErrors(const DiscoveryProblem& problem, const BlockStatistics& statistics,
              const std::vector<int>& columns, const std::vector<int>& groups);

  /// False where columns of the model can hardly be told apart in some fold's training data: digits
  /// are lost, and nothing may be asked.
  [[nodiscard]] bool are_reliable() const { return reliable_; }
  /// A bound on what rounding may have changed of an error.
  [[nodiscard]] double rounding() const { return rounding_; }

  /// Of the model less the columns at some places of it.
  struct Less {
    FoldErrors base;                ///< without a group more
    std::vector<FoldErrors> with;   ///< with each of the groups
  };
  [[nodiscard]] Less errors_less(const std::vector<Eigen::Index>& places,
                                 const std::vector<int>& groups) const;

 private:
  struct Fold {
    Eigen::MatrixXd inverse;  ///< V
    Eigen::VectorXd base, test_value;
    Eigen::MatrixXd test_gram;
    /// A column for each of the groups': coefficients on the model; and V times its test products with the
    /// model less test_gram times the first.
    Eigen::MatrixXd on_model, left;
    std::vector<Eigen::MatrixXd> schur;    ///< per group asked: what is left of it in training
    std::vector<Eigen::VectorXd> right;    ///< the value's products with that
    std::vector<Eigen::MatrixXd> squares;  ///< what a coefficient of the group adds to the error, squared
    std::vector<Eigen::VectorXd> linear;   ///< half of what it adds, not squared
  };
  struct Without;
  void add_fold(int fold, const std::vector<int>& columns, const std::vector<int>& groups);
  [[nodiscard]] double error_with_group(int fold, int group, const Without& without) const;
  template <int kColumns>
  [[nodiscard]] double error_with(int fold, int group, const Without& without) const;

  const DiscoveryProblem& problem_;
  const BlockStatistics& statistics_;
  std::vector<int> slot_;           ///< per group: its place in schur; -1: not asked
  std::vector<Eigen::Index> first_;  ///< per group: its first column in on_model
  std::vector<Fold> folds_;
  double rounding_ = 0.0;
  bool reliable_ = true;
};

}  // namespace trueflank::loop
