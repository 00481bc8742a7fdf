// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/block_statistics.h"

#include <algorithm>
#include <map>

namespace trueflank::loop {

BlockStatistics::BlockStatistics(const DiscoveryProblem& problem)
    : problem_(problem),
      candidates_(problem.candidates),
      value_(problem.value),
      model_(problem.nuisance) {
  for (int i = 0; i < value_.size(); ++i) {
    if (problem.fold[i] == 0) continue;
    order_.push_back(i);
    units_ = std::max(units_, problem.unit[i] + 1);
    folds_ = std::max(folds_, problem.fold[i]);
    total_weight_ += problem.weight[i];
  }
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
    return std::pair(problem.unit[a], problem.fold[a]) < std::pair(problem.unit[b], problem.fold[b]);
  });
  centre_on_zeros();
  unit_sums_.resize(units_);
  fold_sums_.resize(folds_ + 1);
  sum_candidates();
  add_model_sums(0);
}

/// Takes the weighted mean of every trace (apart in training and hold-out) out of all columns.
void BlockStatistics::centre_on_zeros() {
  std::map<int, std::vector<int>> traces;
  for (const int i : order_)
    if (problem_.zero[i] >= 0) traces[problem_.zero[i]].push_back(i);
  for (const auto& [trace, rows] : traces) {
    double weight = 0.0, value = 0.0;
    Eigen::RowVectorXd model = Eigen::RowVectorXd::Zero(model_.cols());
    Eigen::RowVectorXd candidate = Eigen::RowVectorXd::Zero(candidates_.cols());
    for (const int i : rows) {
      const double w = problem_.weight[i];
      weight += w;
      value += w * value_[i];
      model += w * model_.row(i);
      candidate += w * candidates_.row(i).cast<double>();
    }
    model /= weight;
    const Eigen::RowVectorXf mean = (candidate / weight).cast<float>();
    for (const int i : rows) {
      value_[i] -= value / weight;
      model_.row(i) -= model;
      candidates_.row(i) -= mean;
    }
  }
}

void BlockStatistics::sum_candidates() {
  const auto columns = candidates_.cols();
  const auto clear = [&](Sums& sums) { sums.candidate_value = Eigen::VectorXd::Zero(columns); };
  for (Sums& sums : unit_sums_) clear(sums);
  for (Sums& sums : fold_sums_) clear(sums);
  clear(all_);
  const std::size_t groups = problem_.groups.size();
  group_grams_.assign(folds_ + 1, std::vector<Eigen::MatrixXd>(groups));
  for (auto& fold : group_grams_)
    for (std::size_t g = 0; g < groups; ++g)
      fold[g] = Eigen::MatrixXd::Zero(problem_.groups[g].columns, problem_.groups[g].columns);
  std::map<std::pair<int, int>, std::pair<double, Eigen::VectorXd>> trace_parts;
  std::map<int, double> trace_weight;
  for (const int i : order_) {
    const double w = problem_.weight[i];
    const int unit = problem_.unit[i], fold = problem_.fold[i];
    const Eigen::VectorXd x = candidates_.row(i).transpose().cast<double>();
    const double wy = w * value_[i];
    unit_sums_[unit].candidate_value += wy * x;
    fold_sums_[fold].candidate_value += wy * x;
    for (Sums* sums : {&unit_sums_[unit], &fold_sums_[fold], &all_}) {
      sums->value_value += wy * value_[i];
      sums->weight += w;
    }
    for (std::size_t g = 0; g < groups; ++g) {
      const CandidateGroup& group = problem_.groups[g];
      const double* part = x.data() + group.first_column;
      Eigen::MatrixXd& gram = group_grams_[fold][g];
      for (int a = 0; a < group.columns; ++a)
        for (int b = 0; b < group.columns; ++b) gram(a, b) += w * part[a] * part[b];
    }
    if (problem_.zero[i] >= 0) {
      auto& [weight, sum] = trace_parts[{problem_.zero[i], unit}];
      if (sum.size() == 0) sum = Eigen::VectorXd::Zero(columns);
      weight += w;
      sum += w * x;
      trace_weight[problem_.zero[i]] += w;
    }
  }
  zero_loss_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const CandidateGroup& group = problem_.groups[g];
    zero_loss_[g] = Eigen::MatrixXd::Zero(group.columns, group.columns);
    for (const auto& [key, part] : trace_parts) {
      const auto segment = part.second.segment(group.first_column, group.columns);
      zero_loss_[g] += segment * segment.transpose() / trace_weight[key.first];
    }
    for (int fold = 1; fold <= folds_; ++fold) group_grams_[0][g] += group_grams_[fold][g];
  }
  for (const Sums& sums : unit_sums_) all_.candidate_value += sums.candidate_value;
}

int BlockStatistics::add_group(int group) {
  const CandidateGroup& added = problem_.groups[group];
  const int first = model_columns();
  model_.conservativeResize(Eigen::NoChange, first + added.columns);
  model_.rightCols(added.columns) =
      candidates_.middleCols(added.first_column, added.columns).cast<double>();
  add_model_sums(first);
  return first;
}

void BlockStatistics::add_model_sums(int first) {
  const int m = model_columns();
  const auto p = candidates_.cols();
  const auto grow = [&](Sums& sums) {
    sums.model_model.conservativeResize(m, m);
    sums.model_model.rightCols(m - first).setZero();
    sums.model_model.bottomRows(m - first).setZero();
    sums.model_value.conservativeResize(m);
    sums.model_value.tail(m - first).setZero();
    sums.model_candidate.conservativeResize(m, p);
    sums.model_candidate.bottomRows(m - first).setZero();
  };
  for (Sums& sums : unit_sums_) grow(sums);
  for (Sums& sums : fold_sums_) grow(sums);
  grow(all_);
  const int added = m - first;
  // One unit within one fold at a time, so that each value is added once.
  Eigen::MatrixXd part_candidate(p, added);
  for (std::size_t begin = 0; begin < order_.size();) {
    const int unit = problem_.unit[order_[begin]], fold = problem_.fold[order_[begin]];
    part_candidate.setZero();
    Eigen::MatrixXd part_model = Eigen::MatrixXd::Zero(m, added);
    Eigen::VectorXd part_value = Eigen::VectorXd::Zero(added);
    std::size_t end = begin;
    for (; end < order_.size(); ++end) {
      const int i = order_[end];
      if (problem_.unit[i] != unit || problem_.fold[i] != fold) break;
      for (int k = 0; k < added; ++k) {
        const double a = problem_.weight[i] * model_(i, first + k);
        part_candidate.col(k) += a * candidates_.row(i).transpose().cast<double>();
        part_model.col(k) += a * model_.row(i).transpose();
        part_value[k] += a * value_[i];
      }
    }
    for (Sums* sums : {&unit_sums_[unit], &fold_sums_[fold], &all_}) {
      sums->model_candidate.bottomRows(added) += part_candidate.transpose();
      sums->model_model.rightCols(added) += part_model;
      sums->model_value.tail(added) += part_value;
    }
    begin = end;
  }
  const auto mirror = [&](Sums& sums) {
    sums.model_model.bottomLeftCorner(added, first) =
        sums.model_model.topRightCorner(first, added).transpose();
  };
  for (Sums& sums : unit_sums_) mirror(sums);
  for (Sums& sums : fold_sums_) mirror(sums);
  mirror(all_);
}

}  // namespace trueflank::loop
