// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/quick_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstring>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// Columns of one group.
constexpr int kMostOfGroup = 8;

/// Of a column's own square in the training data: with less left beside the others digits are lost.
constexpr double kToldApart = 1e-7;
/// Of the sum of squares: some hundred times what was seen.
constexpr double kRoundingOfErrors = 1e-9;

/// Product with many columns: eight rows and four columns of the result at a time, in the widest registers.
Eigen::MatrixXd wide_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
  constexpr Eigen::Index kRows = 8, kColumns = 4;
  const Eigen::Index m = a.rows(), rows = (m + kRows - 1) / kRows * kRows;
  // Rows beyond the last are 0.
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(rows, m);
  left.topRows(m) = a;
  Eigen::MatrixXd result(m, b.cols());
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (Eigen::Index column = 0; column < b.cols(); column += kColumns) {
      const double* from[kColumns];
      for (Eigen::Index c = 0; c < kColumns; ++c)
        from[c] = b.data() + std::min(column + c, b.cols() - 1) * m;
      for (Eigen::Index row = 0; row < rows; row += kRows) {
        Four sums[2 * kColumns] = {};
        for (Eigen::Index k = 0; k < m; ++k) {
          Four low, high;
          std::memcpy(&low, left.data() + k * rows + row, sizeof low);
          std::memcpy(&high, left.data() + k * rows + row + 4, sizeof high);
          for (Eigen::Index c = 0; c < kColumns; ++c) {
            const double f = from[c][k];
            const Four factor{f, f, f, f};
            sums[2 * c] += factor * low;
            sums[2 * c + 1] += factor * high;
          }
        }
        const Eigen::Index used = std::min(kRows, m - row);
        for (Eigen::Index c = 0; c < kColumns && column + c < b.cols(); ++c)
          std::memcpy(result.data() + (column + c) * m + row, &sums[2 * c],
                      static_cast<std::size_t>(used) * sizeof(double));
      }
    }
  });
  return result;
}

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
  Eigen::MatrixXd crossed_test(m, asked);
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto column = static_cast<std::size_t>(columns[static_cast<std::size_t>(k)]);
    Eigen::Index at = 0;
    for (const int group : groups) {
      const CandidateGroup& g = problem_.groups[static_cast<std::size_t>(group)];
      for (int c = 0; c < g.columns; ++c, ++at) {
        crossed_test(k, at) = test.model_candidate[column][g.first_column + c];
        trained(k, at) = all.model_candidate[column][g.first_column + c] - crossed_test(k, at);
      }
    }
  }
  f.on_model = wide_product(f.inverse, trained);
  const Eigen::MatrixXd tested = wide_product(f.test_gram, f.on_model);
  f.left = wide_product(f.inverse, crossed_test - tested);
  const Eigen::VectorXd base_left = f.test_gram * f.base - f.test_value;
  const Eigen::VectorXd linear = crossed_test.transpose() * f.base - f.on_model.transpose() * base_left;
  for (const int group : groups) {
    const CandidateGroup& g = problem_.groups[static_cast<std::size_t>(group)];
    const auto own = Eigen::seqN(first_[static_cast<std::size_t>(group)], g.columns);
    const auto there = Eigen::seqN(g.first_column, g.columns);
    const Eigen::MatrixXd &all_group = statistics_.group_gram(group, 0),
                          &test_group = statistics_.group_gram(group, fold + 1);
    Eigen::MatrixXd schur = all_group - test_group;
    schur.diagonal() += 1e-6 * all_group.diagonal() + Eigen::VectorXd::Constant(g.columns, 1e-30);
    const Eigen::MatrixXd on_model = f.on_model(Eigen::all, own);
    const Eigen::MatrixXd crossed = on_model.transpose() * crossed_test(Eigen::all, own);
    f.schur.emplace_back(schur - trained(Eigen::all, own).transpose() * on_model);
    f.right.emplace_back(all.candidate_value(there) - test.candidate_value(there) -
                         on_model.transpose() * train_value);
    f.squares.emplace_back(test_group + on_model.transpose() * tested(Eigen::all, own) -
                           crossed - crossed.transpose());
    f.linear.emplace_back(linear(own) - test.candidate_value(there));
  }
}

/// What leaving columns out changes in one fold.
struct QuickErrors::Without {
  const std::vector<Eigen::Index>& places;
  Eigen::MatrixXd own;            ///< (V_SS)^-1
  Eigen::MatrixXd change_square;  ///< D' test_gram D
  Eigen::VectorXd own_base;       ///< (V_SS)^-1 times the coefficients left out
  Eigen::VectorXd change_left;    ///< D' times test_gram b less the value's products, b without S
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
    const Eigen::MatrixXd change = beside * without.own;
    without.change_square = change.transpose() * (f.test_gram * change);
    without.own_base = without.own * f.base(places);
    Eigen::VectorXd base = f.base - change * f.base(places);
    base(places).setZero();
    const Eigen::VectorXd tested = f.test_gram * base;
    without.change_left = change.transpose() * (tested - f.test_value);
    without.error = statistics_.fold(static_cast<int>(i) + 1).value_value -
                    2.0 * base.dot(f.test_value) + base.dot(tested);
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
  const Eigen::Index at = first_[g], less = without.own.cols();
  OwnMatrix schur = f.schur[slot], squares = f.squares[slot];
  OwnVector right = f.right[slot], linear = f.linear[slot];
  const Eigen::Index columns = right.size();
  const auto place = [&](Eigen::Index s) { return without.places[static_cast<std::size_t>(s)]; };
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (Eigen::Index s = 0; s < less; ++s) {
      const double left_out = f.on_model(place(s), at + c);
      right[c] += left_out * without.own_base[s];
      linear[c] += left_out * without.change_left[s] - f.left(place(s), at + c) * without.own_base[s];
    }
    linear[c] *= 2.0;
  }
  for (Eigen::Index s = 0; s < less; ++s)
    for (Eigen::Index t = 0; t < less; ++t) {
      const double own = without.own(s, t), change = without.change_square(s, t);
      for (Eigen::Index b = 0; b < columns; ++b) {
        const double other = f.on_model(place(t), at + b), left = own * f.left(place(t), at + b);
        for (Eigen::Index a = 0; a < columns; ++a) {
          const double left_out = f.on_model(place(s), at + a), moved = left_out * left;
          squares(a, b) += moved + left_out * change * other;
          squares(b, a) += moved;
          schur(a, b) += left_out * own * other;
        }
      }
    }
  const OwnVector b = schur.ldlt().solve(right);
  return without.error + b.dot(linear) + b.dot(squares * b);
}

}  // namespace trueflank::loop
