// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/trial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

SymmetricSolver decomposed(Eigen::MatrixXd normal) {
  normal.diagonal() *= 1.0 + 1e-12;
  normal.diagonal().array() += 1e-30;
  return SymmetricSolver(normal);
}

/// Of normal equations whose last row and column are the value's.
double square_of(const Eigen::MatrixXd& gram, const Eigen::VectorXd& b) {
  const auto n = b.size();
  return gram(n, n) - 2.0 * b.dot(gram.col(n).head(n)) + b.dot(gram.topLeftCorner(n, n) * b);
}

TrialFit::Trial judged(const Eigen::MatrixXd& gram, Eigen::Index first, Eigen::Index columns,
                       double below) {
  const Eigen::Index n = gram.rows() - 1;
  const auto solver = decomposed(gram.topLeftCorner(n, n));
  TrialFit::Trial result{square_of(gram, solver.solve(gram.col(n).head(n))), 0.0};
  if (!(result.square < below)) return result;
  result.retained = 1.0;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n).middleCols(first, columns);
  const Eigen::MatrixXd inverse = solver.solve_columns(unit);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double own = gram(first + k, first + k);
    result.retained =
        own > 0.0 ? std::min(result.retained, 1.0 / (inverse(first + k, k) * own)) : 0.0;
  }
  return result;
}

}  // namespace

const Eigen::MatrixXd* TriedColumns::find(const Effect& effect) const {
  const auto found = std::find_if(tried_.begin(), tried_.end(),
                                  [&](const Tried& tried) { return tried.effect == effect; });
  return found == tried_.end() ? nullptr : &found->columns;
}

void TriedColumns::keep(const Effect& effect, const Eigen::MatrixXd& columns) {
  constexpr Eigen::Index kMostValues = 6'000'000;
  if (values_ + columns.size() > kMostValues || find(effect) != nullptr) return;
  values_ += columns.size();
  tried_.push_back({effect, columns});
}

TrialFit::TrialFit(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                   std::vector<Effect> effects, std::size_t stride, TriedColumns* tried)
    : geometry_(geometry), table_(table), effects_(std::move(effects)), tried_(tried) {
  trace_weight_.assign(static_cast<std::size_t>(table.traces), 0.0);
  for (std::size_t i = 0; i < table.rows.size(); i += stride) {
    if (patches.patch_of_row[i] < 0) continue;
    const auto& patch = patches.patches[static_cast<std::size_t>(patches.patch_of_row[i])];
    const double weight = patch.weight / patch.count;
    const int trace = table.rows[i].trace;
    rows_.push_back({static_cast<std::uint32_t>(i), trace, std::sqrt(weight)});
    if (trace >= 0) trace_weight_[static_cast<std::size_t>(trace)] += weight;
  }
  const NuisanceColumns nuisance(geometry, table);
  Eigen::Index columns = nuisance.count();
  for (const Effect& effect : effects_) {
    first_column_.push_back(columns);
    columns += effect.columns();
  }
  columns_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), columns + 1);
  Eigen::MatrixXd own =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), nuisance.count() + 1);
  std::vector<double> values(static_cast<std::size_t>(nuisance.count()) + 1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Observation& row = table.rows[rows_[i].row];
    std::fill(values.begin(), values.end(), 0.0);
    for (std::uint32_t k = 0; k < row.places; ++k) {
      const Place& place = table.places[row.first_place + k];
      nuisance.add(place, row.kind, row.source, row.weight, values.data());
    }
    values.back() = row.deviation_um;
    for (std::size_t k = 0; k < values.size(); ++k)
      own(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[k];
  }
  centre(own);
  columns_.leftCols(nuisance.count()) = own.leftCols(nuisance.count());
  columns_.col(columns) = own.col(nuisance.count());
  std::vector<std::size_t> all(effects_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  put_columns(all);
  gram_ = columns_.transpose() * columns_;
  solve();
}

/// Takes the weighted mean of every trace out and puts the roots of the weights on.
void TrialFit::centre(Eigen::MatrixXd& columns) const {
  std::vector<double> mean(trace_weight_.size());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    std::fill(mean.begin(), mean.end(), 0.0);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i].trace >= 0)
        mean[static_cast<std::size_t>(rows_[i].trace)] +=
            rows_[i].root * rows_[i].root * columns(static_cast<Eigen::Index>(i), k);
    for (std::size_t t = 0; t < mean.size(); ++t)
      if (trace_weight_[t] > 0.0) mean[t] /= trace_weight_[t];
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double& value = columns(static_cast<Eigen::Index>(i), k);
      if (rows_[i].trace >= 0) value -= mean[static_cast<std::size_t>(rows_[i].trace)];
      value *= rows_[i].root;
    }
  }
}

Eigen::MatrixXd TrialFit::columns_of(const Effect& effect) const {
  const int count = effect.columns();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), count);
  double one[8];
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Observation& row = table_.rows[rows_[i].row];
    for (std::uint32_t p = 0; p < row.places; ++p) {
      effect.evaluate(geometry_, table_.places[row.first_place + p], one);
      for (int k = 0; k < count; ++k)
        columns(static_cast<Eigen::Index>(i), k) += row.weight * one[k];
    }
  }
  centre(columns);
  return columns;
}

void TrialFit::solve() {
  const Eigen::Index n = gram_.rows() - 1;
  coefficients_ = decomposed(gram_.topLeftCorner(n, n)).solve(gram_.col(n).head(n));
  square_ = square_of(gram_, coefficients_);
}

Eigen::VectorXd TrialFit::coefficients(std::size_t effect) const {
  return coefficients_.segment(first_column_[effect], effects_[effect].columns());
}

TrialFit::Trial TrialFit::as_is(std::size_t effect) const {
  return judged(gram_, first_column_[effect], effects_[effect].columns(),
                std::numeric_limits<double>::infinity());
}

/// Puts the columns of effects where they belong.
void TrialFit::put_columns(const std::vector<std::size_t>& effects) {
  for_each_piece(effects.size(), [&](std::size_t i) {
    const std::size_t e = effects[i];
    const Eigen::MatrixXd* known = tried_ != nullptr ? tried_->find(effects_[e]) : nullptr;
    auto place = columns_.middleCols(first_column_[e], effects_[e].columns());
    if (known != nullptr) place = *known;
    else place = columns_of(effects_[e]);
  });
}

std::vector<TrialFit::Trial> TrialFit::with_shapes(std::size_t effect,
                                                   const std::vector<EffectShape>& shapes,
                                                   double below) const {
  std::vector<Trial> trials(shapes.size());
  std::vector<Effect> moved(shapes.size(), effects_[effect]);
  std::vector<Eigen::MatrixXd> own(shapes.size());
  for_each_piece(shapes.size(), [&](std::size_t i) {
    moved[i].shape = shapes[i];
    const Eigen::MatrixXd* known = tried_ != nullptr ? tried_->find(moved[i]) : nullptr;
    if (known == nullptr) own[i] = columns_of(moved[i]);
    trials[i] = with_columns(effect, known != nullptr ? *known : own[i], below);
  });
  for (std::size_t i = 0; tried_ != nullptr && i < shapes.size(); ++i)
    if (own[i].size() > 0) tried_->keep(moved[i], own[i]);
  return trials;
}

TrialFit::Trial TrialFit::with_columns(std::size_t effect, const Eigen::MatrixXd& columns,
                                       double below) const {
  const Eigen::Index first = first_column_[effect], count = columns.cols();
  Eigen::MatrixXd gram = gram_;
  // (of few columns: a product of matrices would copy all the others first)
  for (Eigen::Index k = 0; k < count; ++k)
    gram.col(first + k).noalias() = columns_.transpose() * columns.col(k);
  // (a copy: a first effect's rows and columns begin at the same place)
  gram.middleRows(first, count) = gram.middleCols(first, count).transpose().eval();
  gram.block(first, first, count, count) = columns.transpose() * columns;
  return judged(gram, first, count, below);
}

void TrialFit::set_shapes(const std::vector<Effect>& effects) {
  std::vector<std::size_t> moved;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (effects[e].shape == effects_[e].shape) continue;
    effects_[e].shape = effects[e].shape;
    moved.push_back(e);
  }
  put_columns(moved);
  for (const std::size_t e : moved) {
    const Eigen::Index first = first_column_[e], count = effects_[e].columns();
    gram_.middleCols(first, count) = columns_.transpose() * columns_.middleCols(first, count);
    gram_.middleRows(first, count) = gram_.middleCols(first, count).transpose().eval();
  }
  solve();
}

Eigen::VectorXd TrialFit::joint_coefficients(const Eigen::MatrixXd& more) const {
  const Eigen::Index n = gram_.rows() - 1, m = more.cols();
  const Eigen::MatrixXd cross = columns_.transpose() * more;  // the value's row last
  Eigen::MatrixXd normal(n + m, n + m);
  normal.topLeftCorner(n, n) = gram_.topLeftCorner(n, n);
  normal.topRightCorner(n, m) = cross.topRows(n);
  normal.bottomLeftCorner(m, n) = cross.topRows(n).transpose();
  normal.bottomRightCorner(m, m) = more.transpose() * more;
  Eigen::VectorXd right(n + m);
  right << gram_.col(n).head(n), cross.row(n).transpose();
  return decomposed(std::move(normal)).solve(right).tail(m);
}

}  // namespace trueflank::loop
