// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/quick_errors.h"

#include <Eigen/Cholesky>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Columns of one group.
constexpr int kMostOfGroup = 8;

/// Of a column's own square in the training data: with less left beside the others digits are lost.
constexpr double kToldApart = 1e-7;
/// Of the sum of squares: some hundred times what was seen.
constexpr double kRoundingOfErrors = 1e-9;

}  // namespace

QuickErrors::QuickErrors(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                         const std::vector<int>& columns, const std::vector<int>& groups)
    : problem_(problem),
      statistics_(statistics),
      slot_(problem.groups.size(), -1),
      first_(problem.groups.size(), 0),
      folds_(static_cast<std::size_t>(statistics.folds())),
      rounding_(kRoundingOfErrors * statistics.all().value_value) {
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto group = static_cast<std::size_t>(groups[i]);
    slot_[group] = static_cast<int>(i);
    first_[group] = at;
    at += problem.groups[group].columns;
  }
  std::vector<char> told_apart(folds_.size(), 1);
  for_each_piece(folds_.size(), [&](std::size_t i) {
    add_fold(static_cast<int>(i), columns, groups);
    const Fold& f = folds_[i];
    const auto& all = statistics_.all();
    for (Eigen::Index k = 0; k < f.inverse.rows(); ++k) {
      const int column = columns[static_cast<std::size_t>(k)];
      if (!(1.0 > kToldApart * f.inverse(k, k) * all.model_model(column, column)))
        told_apart[i] = 0;
    }
  });
  for (const char is : told_apart) reliable_ = reliable_ && is != 0;
}

void QuickErrors::add_fold(int fold, const std::vector<int>& columns,
                           const std::vector<int>& groups) {
  Fold& f = folds_[static_cast<std::size_t>(fold)];
  const auto& all = statistics_.all();
  const auto& test = statistics_.fold(fold + 1);
  const auto m = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd whole = all.model_model(columns, columns);
  f.test_gram = test.model_model(columns, columns);
  f.test_value = test.model_value(columns);
  Eigen::MatrixXd train = whole - f.test_gram;
  train.diagonal() += 1e-10 * whole.diagonal() + Eigen::VectorXd::Constant(m, 1e-30);
  f.inverse = SymmetricSolver(train).solve_columns(Eigen::MatrixXd::Identity(m, m));
  const Eigen::VectorXd train_value = all.model_value(columns) - f.test_value;
  f.base = f.inverse * train_value;
  Eigen::Index asked = 0;
  for (const int group : groups) asked += problem_.groups[static_cast<std::size_t>(group)].columns;
  Eigen::MatrixXd trained(m, asked);
  f.crossed.resize(m, asked);
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto column = static_cast<std::size_t>(columns[static_cast<std::size_t>(k)]);
    Eigen::Index at = 0;
    for (const int group : groups) {
      const CandidateGroup& g = problem_.groups[static_cast<std::size_t>(group)];
      for (int c = 0; c < g.columns; ++c, ++at) {
        f.crossed(k, at) = test.model_candidate[column][g.first_column + c];
        trained(k, at) = all.model_candidate[column][g.first_column + c] - f.crossed(k, at);
      }
    }
  }
  f.on_model = f.inverse * trained;
  const Eigen::MatrixXd tested = f.test_gram * f.on_model;
  f.left = f.crossed - tested;
  for (const int group : groups) {
    const CandidateGroup& g = problem_.groups[static_cast<std::size_t>(group)];
    const auto own = Eigen::seqN(first_[static_cast<std::size_t>(group)], g.columns);
    const auto there = Eigen::seqN(g.first_column, g.columns);
    const Eigen::MatrixXd &all_group = statistics_.group_gram(group, 0),
                          &test_group = statistics_.group_gram(group, fold + 1);
    Eigen::MatrixXd schur = all_group - test_group;
    schur.diagonal() += 1e-6 * all_group.diagonal() + Eigen::VectorXd::Constant(g.columns, 1e-30);
    const Eigen::MatrixXd on_model = f.on_model(Eigen::all, own);
    const Eigen::MatrixXd crossed = on_model.transpose() * f.crossed(Eigen::all, own);
    f.schur.emplace_back(schur - trained(Eigen::all, own).transpose() * on_model);
    f.right.emplace_back(all.candidate_value(there) - test.candidate_value(there) -
                         on_model.transpose() * train_value);
    f.squares.emplace_back(test_group + on_model.transpose() * tested(Eigen::all, own) -
                           crossed - crossed.transpose());
  }
}

/// What leaving columns out changes in one fold.
struct QuickErrors::Without {
  const std::vector<Eigen::Index>& places;
  Eigen::MatrixXd change;         ///< D
  Eigen::MatrixXd change_tested;  ///< test_gram times D
  Eigen::MatrixXd change_square;  ///< D' test_gram D
  Eigen::MatrixXd own;            ///< (V_SS)^-1
  Eigen::VectorXd own_base;       ///< that times the coefficients left out
  Eigen::VectorXd base;           ///< coefficients of the others; 0 where columns are left out
  Eigen::VectorXd left;           ///< test_gram times base, less the value's products
  Eigen::VectorXd change_left;    ///< D' times that
  double error = 0.0;             ///< without a group more
};

QuickErrors::Less QuickErrors::errors_less(const std::vector<Eigen::Index>& places,
                                           const std::vector<int>& groups) const {
  TRUEFLANK_EXPECTS(reliable_);
  const auto count = static_cast<Eigen::Index>(folds_.size());
  Less less{FoldErrors(count), std::vector<FoldErrors>(groups.size(), FoldErrors(count))};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Fold& f = folds_[static_cast<std::size_t>(i)];
    Without without{.places = places};
    const Eigen::MatrixXd beside = f.inverse(Eigen::all, places);
    without.own = SymmetricSolver(beside(places, Eigen::all))
                      .solve_columns(Eigen::MatrixXd::Identity(beside.cols(), beside.cols()));
    without.change = beside * without.own;
    without.change_tested = f.test_gram * without.change;
    without.change_square = without.change.transpose() * without.change_tested;
    without.own_base = without.own * f.base(places);
    without.base = f.base - without.change * f.base(places);
    without.base(places).setZero();
    const Eigen::VectorXd tested = f.test_gram * without.base;
    without.left = tested - f.test_value;
    without.change_left = without.change.transpose() * without.left;
    without.error = statistics_.fold(static_cast<int>(i) + 1).value_value -
                    2.0 * without.base.dot(f.test_value) + without.base.dot(tested);
    less.base[i] = without.error;
    for (std::size_t g = 0; g < groups.size(); ++g)
      less.with[g][i] = error_with_group(static_cast<int>(i), groups[g], without);
  }
  return less;
}

double QuickErrors::error_with_group(int fold, int group, const Without& without) const {
  switch (problem_.groups[static_cast<std::size_t>(group)].columns) {
    case 1: return error_with<1>(fold, group, without);
    case 2: return error_with<2>(fold, group, without);
    default: return error_with<Eigen::Dynamic>(fold, group, without);
  }
}

/// With coefficients b of the group the error is that without it, and b'l + b'Qb more.
template <int kColumns>
double QuickErrors::error_with(int fold, int group, const Without& without) const {
  // few columns, and so without memory of their own
  constexpr int kMost = kColumns == Eigen::Dynamic ? kMostOfGroup : kColumns;
  using OwnMatrix = Eigen::Matrix<double, kColumns, kColumns, 0, kMost, kMost>;
  using OwnVector = Eigen::Matrix<double, kColumns, 1, 0, kMost, 1>;
  const Fold& f = folds_[static_cast<std::size_t>(fold)];
  const auto g = static_cast<std::size_t>(group);
  const auto slot = static_cast<std::size_t>(slot_[g]);
  const Eigen::Index at = first_[g], less = without.change.cols();
  const auto& test = statistics_.fold(fold + 1);
  OwnMatrix schur = f.schur[slot], squares = f.squares[slot];
  OwnVector right = f.right[slot], linear = OwnVector::Zero(right.size());
  const Eigen::Index columns = right.size();
  for (Eigen::Index c = 0; c < columns; ++c) {
    const auto on_model = f.on_model.col(at + c);
    linear[c] = 2.0 * (f.crossed.col(at + c).dot(without.base) - on_model.dot(without.left) -
                       test.candidate_value[problem_.groups[g].first_column + c]);
    for (Eigen::Index s = 0; s < less; ++s) {
      const double left_out = on_model[without.places[static_cast<std::size_t>(s)]];
      right[c] += left_out * without.own_base[s];
      linear[c] += 2.0 * left_out * without.change_left[s];
    }
  }
  for (Eigen::Index a = 0; a < columns; ++a)
    for (Eigen::Index s = 0; s < less; ++s) {
      const double left_out = f.on_model(without.places[static_cast<std::size_t>(s)], at + a);
      const auto change = without.change.col(s);
      for (Eigen::Index b = 0; b < columns; ++b) {
        const double moved = left_out * f.left.col(at + b).dot(change);
        squares(a, b) += moved;
        squares(b, a) += moved;
        for (Eigen::Index t = 0; t < less; ++t) {
          const double other = f.on_model(without.places[static_cast<std::size_t>(t)], at + b);
          schur(a, b) += left_out * without.own(s, t) * other;
          squares(a, b) += left_out * without.change_square(s, t) * other;
        }
      }
    }
  const OwnVector b = schur.ldlt().solve(right);
  return without.error + b.dot(linear) + b.dot(squares * b);
}

}  // namespace trueflank::loop
