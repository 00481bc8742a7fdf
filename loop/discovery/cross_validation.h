// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/block_statistics.h"
#include "trueflank/loop/discovery/column_panels.h"

namespace trueflank::loop {

/// Squared error on each fold 1 ... K.
using FoldErrors = Eigen::VectorXd;

/// Squared error on every fold of the model of some columns and perhaps one group more, fitted to
/// the other folds.
class CrossValidation {
 public:
  CrossValidation(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                  std::vector<int> columns);

  [[nodiscard]] FoldErrors base_errors() const;
  /// With one group more: of each of these groups, on all processors.
  [[nodiscard]] std::vector<FoldErrors> errors_with(const std::vector<int>& groups) const;

 private:
  struct Fold {
    PanelSolver train;
    Eigen::VectorXd train_value, base, test_value;
    Eigen::VectorXd test_base;  ///< test_gram * base
    Eigen::MatrixXd test_gram;
  };
  struct Solved;
  void add_errors(const int* groups, std::size_t count, FoldErrors* errors) const;
  [[nodiscard]] double error_of(int group, int at, int fold, const Solved& solved) const;

  const DiscoveryProblem& problem_;
  const BlockStatistics& statistics_;
  std::vector<int> columns_;
  std::vector<Fold> folds_;
};

}  // namespace trueflank::loop
