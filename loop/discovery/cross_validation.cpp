// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/cross_validation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Of the columns of one group: few, and so without memory of their own.
constexpr int kMostBatchColumns = 8;
static_assert(kMostBatchColumns <= kPanelColumns);
using GroupMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostBatchColumns, kMostBatchColumns>;
using GroupVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostBatchColumns, 1>;

}  // namespace

CrossValidation::CrossValidation(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                                 std::vector<int> columns)
    : problem_(problem), statistics_(statistics), columns_(std::move(columns)) {
  const Eigen::MatrixXd all = statistics_.all().model_model(columns_, columns_);
  for (int fold = 1; fold <= statistics_.folds(); ++fold) {
    const auto& sums = statistics_.fold(fold);
    Fold f;
    f.test_gram = sums.model_model(columns_, columns_);
    f.test_value = sums.model_value(columns_);
    Eigen::MatrixXd train = all - f.test_gram;
    // A column that lives only in this fold cannot be learnt from the others.
    train.diagonal() += 1e-10 * all.diagonal() + Eigen::VectorXd::Constant(train.rows(), 1e-30);
    const SymmetricSolver solver(train);
    f.train_value = statistics_.all().model_value(columns_) - f.test_value;
    f.base = solver.solve(f.train_value);
    f.test_base = f.test_gram * f.base;
    f.train = PanelSolver(solver);
    folds_.push_back(std::move(f));
  }
}

FoldErrors CrossValidation::base_errors() const {
  FoldErrors errors(static_cast<Eigen::Index>(folds_.size()));
  for (std::size_t i = 0; i < folds_.size(); ++i) {
    const Fold& f = folds_[i];
    errors[static_cast<Eigen::Index>(i)] = statistics_.fold(static_cast<int>(i) + 1).value_value -
                                           2.0 * f.base.dot(f.test_value) + f.base.dot(f.test_base);
  }
  return errors;
}

std::vector<FoldErrors> CrossValidation::errors_with(const std::vector<int>& groups) const {
  std::vector<FoldErrors> errors(groups.size(),
                                 FoldErrors(static_cast<Eigen::Index>(folds_.size())));
  // As many groups at a time as a panel holds.
  std::vector<std::size_t> starts;
  int columns = kPanelColumns;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const int own = problem_.groups[static_cast<std::size_t>(groups[i])].columns;
    TRUEFLANK_EXPECTS(own <= kMostBatchColumns);
    if (columns + own > kPanelColumns) {
      starts.push_back(i);
      columns = 0;
    }
    columns += own;
  }
  starts.push_back(groups.size());
  constexpr std::size_t kAtOnce = 4;
  for_each_run(starts.size() - 1, kAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      add_errors(groups.data() + starts[k], starts[k + 1] - starts[k], errors.data() + starts[k]);
  });
  return errors;
}

/// Of a panel of columns on one fold.
struct CrossValidation::Solved {
  Panel train_cross;   ///< M: products of the model's columns with them, over the other folds
  Panel test_cross;    ///< over this fold
  Panel coefficients;  ///< of them on the model
  Panel tested;        ///< test_gram times those
};

void CrossValidation::add_errors(const int* groups, std::size_t count, FoldErrors* errors) const {
  const std::size_t m = columns_.size();
  const PanelRow none{};
  Solved solved{Panel(m), Panel(m, none), Panel(m, none), Panel(m)};
  for (std::size_t i = 0; i < folds_.size(); ++i) {
    const Fold& f = folds_[i];
    const auto& test = statistics_.fold(static_cast<int>(i) + 1);
    const auto& all = statistics_.all();
    for (std::size_t k = 0; k < m; ++k) {
      const auto column = static_cast<std::size_t>(columns_[k]);
      int at = 0;
      for (std::size_t g = 0; g < count; ++g) {
        const CandidateGroup& group = problem_.groups[static_cast<std::size_t>(groups[g])];
        for (int c = 0; c < group.columns; ++c, ++at) {
          const double tested = test.model_candidate[column][group.first_column + c];
          solved.test_cross[k][static_cast<std::size_t>(at)] = tested;
          solved.train_cross[k][static_cast<std::size_t>(at)] =
              all.model_candidate[column][group.first_column + c] - tested;
        }
      }
    }
    Panel in_places(m);
    for (std::size_t k = 0; k < m; ++k) in_places[k] = solved.train_cross[f.train.row_at(k)];
    f.train.solve_lower(in_places);
    f.train.solve_upper(in_places);
    for (std::size_t k = 0; k < m; ++k) solved.coefficients[f.train.row_at(k)] = in_places[k];
    for (std::size_t k = 0; k < m; ++k) {
      PanelRow& row = solved.tested[k];
      row.fill(0.0);
      subtract_rows(row, f.test_gram.col(static_cast<Eigen::Index>(k)).data(),
                    solved.coefficients.data(), m);
      for (double& value : row) value = -value;
    }
    int at = 0;
    for (std::size_t g = 0; g < count; ++g) {
      errors[g][static_cast<Eigen::Index>(i)] =
          error_of(groups[g], at, static_cast<int>(i) + 1, solved);
      at += problem_.groups[static_cast<std::size_t>(groups[g])].columns;
    }
  }
}

/// Of the group whose columns stand in the panels from `at` on.
double CrossValidation::error_of(int group, int at, int fold, const Solved& solved) const {
  const Fold& f = folds_[static_cast<std::size_t>(fold) - 1];
  const auto& sums = statistics_.fold(fold);
  const CandidateGroup& g = problem_.groups[static_cast<std::size_t>(group)];
  const Eigen::MatrixXd &all_group = statistics_.group_gram(group, 0),
                        &test_group = statistics_.group_gram(group, fold);
  const std::size_t m = columns_.size();
  GroupMatrix schur = all_group - test_group;
  schur.diagonal() += 1e-6 * all_group.diagonal() + GroupVector::Constant(g.columns, 1e-30);
  const GroupVector test_right = sums.candidate_value.segment(g.first_column, g.columns);
  GroupVector right =
      statistics_.all().candidate_value.segment(g.first_column, g.columns) - test_right;
  for (std::size_t k = 0; k < m; ++k) {
    const double* cross = solved.train_cross[k].data() + at;
    const double* own = solved.coefficients[k].data() + at;
    for (int b = 0; b < g.columns; ++b) {
      right[b] -= own[b] * f.train_value[static_cast<Eigen::Index>(k)];
      for (int a = 0; a < g.columns; ++a) schur(a, b) -= cross[a] * own[b];
    }
  }
  const GroupVector b = schur.ldlt().solve(right);
  double error = sums.value_value - 2.0 * b.dot(test_right) + b.dot(test_group * b);
  for (std::size_t k = 0; k < m; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    double a = f.base[row], tested = f.test_base[row], cross = 0.0;
    for (int c = 0; c < g.columns; ++c) {
      a -= solved.coefficients[k][static_cast<std::size_t>(at + c)] * b[c];
      tested -= solved.tested[k][static_cast<std::size_t>(at + c)] * b[c];
      cross += solved.test_cross[k][static_cast<std::size_t>(at + c)] * b[c];
    }
    error += a * (tested + 2.0 * (cross - f.test_value[row]));
  }
  return error;
}

}  // namespace trueflank::loop
