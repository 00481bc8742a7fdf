// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/block_statistics.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/agreement.h"

namespace trueflank::loop {
namespace {

/// How many of `count` are one piece of work: pieces of one size, two for each processor, so that
/// these end together; no larger than `most` and, as long as there are as many, no smaller than
/// `least`.
std::size_t size_of_pieces(std::size_t count, std::size_t least, std::size_t most) {
  const std::size_t pieces = 2 * processors();
  return std::clamp((count + pieces - 1) / pieces, least, most);
}

}  // namespace

BlockStatistics::BlockStatistics(const DiscoveryProblem& problem)
    : problem_(problem),
      value_(problem.value),
      model_(problem.nuisance),
      panels_(panels_of(problem.groups)) {
  order_values();
  clear_sums();
  sum_up({{0, problem.groups.size()}});
}

BlockStatistics::BlockStatistics(const DiscoveryProblem& problem, BlockStatistics&& earlier,
                                 const std::vector<bool>& stayed)
    : problem_(problem),
      value_(problem.value),
      model_(problem.nuisance),
      panels_(panels_of(problem.groups)) {
  order_values();
  clear_sums();
  take_sums_of(earlier, stayed);
  keep_columns_of(earlier, stayed);
  std::vector<Groups> others;
  for (std::size_t g = 0; g < stayed.size(); ++g) {
    if (stayed[g]) continue;
    if (others.empty() || others.back().to != g) others.push_back({g, g});
    others.back().to = g + 1;
  }
  sum_up(others);
}

void BlockStatistics::order_values() {
  for (int i = 0; i < value_.size(); ++i) {
    if (problem_.fold[i] == 0) continue;
    order_.push_back(i);
    units_ = std::max(units_, problem_.unit[i] + 1);
    folds_ = std::max(folds_, problem_.fold[i]);
    total_weight_ += problem_.weight[i];
  }
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
    return std::pair(problem_.unit[a], problem_.fold[a]) <
           std::pair(problem_.unit[b], problem_.fold[b]);
  });
}

/// Of all columns, before any is summed.
void BlockStatistics::clear_sums() {
  const auto columns = problem_.candidates.cols();
  find_wholes();
  unit_sums_.resize(units_);
  fold_sums_.resize(folds_ + 1);
  const auto clear = [&](Sums& sums) { sums.candidate_value = Eigen::VectorXd::Zero(columns); };
  for (Sums& sums : unit_sums_) clear(sums);
  for (Sums& sums : fold_sums_) clear(sums);
  clear(all_);
  group_grams_.assign(folds_ + 1, std::vector<Eigen::MatrixXd>(problem_.groups.size()));
  zero_loss_.resize(problem_.groups.size());
}

/// Of the values, of the columns of some groups and of the nuisance.
void BlockStatistics::sum_up(const std::vector<Groups>& groups) {
  centre_on_zeros(groups);
  sum_candidates(groups);
  add_model_sums(0);
  if (wholes_.size() >= kFewestWholesAsked && wholes_.size() <= kMostWholesAsked)
    scatter_within_ = loop::scatter_within(problem_, *this);
}

void BlockStatistics::take_sums_of(BlockStatistics& earlier, const std::vector<bool>& stayed) {
  centred_ = std::move(earlier.centred_);
  for (std::size_t g = 0, end = 0; g < stayed.size(); g = end + 1) {
    for (end = g; end < stayed.size() && stayed[end];) ++end;
    if (end > g) take_sums_of_columns(earlier, {g, end});
  }
}

void BlockStatistics::take_sums_of_columns(BlockStatistics& earlier, const Groups& groups) {
  const CandidateGroup& last = problem_.groups[groups.to - 1];
  const Eigen::Index first = problem_.groups[groups.from].first_column,
                     columns = last.first_column + last.columns - first;
  const auto take = [&](Sums& sums, const Sums& from) {
    sums.candidate_value.segment(first, columns) = from.candidate_value.segment(first, columns);
  };
  for (std::size_t i = 0; i < unit_sums_.size(); ++i) take(unit_sums_[i], earlier.unit_sums_[i]);
  for (std::size_t i = 0; i < fold_sums_.size(); ++i) take(fold_sums_[i], earlier.fold_sums_[i]);
  take(all_, earlier.all_);
  for (std::size_t g = groups.from; g < groups.to; ++g) {
    for (std::size_t fold = 0; fold < group_grams_.size(); ++fold)
      group_grams_[fold][g] = std::move(earlier.group_grams_[fold][g]);
    zero_loss_[g] = std::move(earlier.zero_loss_[g]);
  }
  const auto all = static_cast<std::size_t>(problem_.candidates.cols()),
             all_before = static_cast<std::size_t>(earlier.all_.candidate_value.size());
  for (auto& [number, whole] : wholes_) {
    const std::vector<double>& before = earlier.wholes_.at(number).products;
    for (std::size_t apart = 0; (apart + 1) * all <= whole.products.size() &&
                                (apart + 1) * all_before <= before.size(); ++apart)
      std::copy_n(before.data() + apart * all_before + first, columns,
                  whole.products.data() + apart * all + first);
  }
}

/// Model columns of an earlier choice and what that had of earlier ones: what is summed of them with panels that
/// stayed.
void BlockStatistics::keep_columns_of(BlockStatistics& earlier, const std::vector<bool>& stayed) {
  // of columns that no choice asked for since
  constexpr std::size_t kMostBytes = 32'000'000;
  std::vector<bool> is_other;
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    is_other.push_back(p >= earlier.panels_.size() || !(panels_[p] == earlier.panels_[p]));
    for (int g = panels_[p].first_group; g < panels_[p].first_group + panels_[p].groups; ++g)
      if (!stayed[static_cast<std::size_t>(g)]) is_other.back() = true;
  }
  for (int k = 0; k < earlier.model_columns(); ++k) {
    const auto column = static_cast<std::size_t>(k);
    KeptColumn kept{.column = earlier.model_.col(k),
                    .of_units = std::move(earlier.unit_candidates_[column]),
                    .of_folds = {},
                    .of_all = std::move(earlier.all_.model_candidate[column]),
                    .lacks = is_other};
    for (Sums& sums : earlier.fold_sums_)
      kept.of_folds.push_back(std::move(sums.model_candidate[column]));
    kept_.push_back(std::move(kept));
  }
  for (KeptColumn& kept : earlier.kept_) {
    if ((kept_.size() - static_cast<std::size_t>(earlier.model_columns())) * bytes_of_column() >
        kMostBytes)
      break;
    kept.lacks.resize(panels_.size(), true);
    for (std::size_t p = 0; p < panels_.size(); ++p)
      if (is_other[p]) kept.lacks[p] = true;
    kept_.push_back(std::move(kept));
  }
}

std::size_t BlockStatistics::bytes_of_column() const {
  const auto units = static_cast<std::size_t>(units_), folds = fold_sums_.size();
  return panels_.size() * kPanelColumns * (units + folds + 1) * sizeof(double);
}

std::size_t BlockStatistics::bytes() const {
  return (kept_.size() + static_cast<std::size_t>(model_columns())) * bytes_of_column() +
         static_cast<std::size_t>(centred_.size()) * sizeof(float);
}

namespace {

/// Takes the weighted mean of rows of single precision out of each; `sums` and `means` are room for one.
void centre_rows(const std::vector<float*>& rows, const std::vector<double>& weights, double weight,
                 std::vector<double>& sums, std::vector<float>& means) {
  double* const sum = sums.data();
  float* const mean = means.data();
  const std::size_t columns = sums.size();
  std::fill(sums.begin(), sums.end(), 0.0);
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const float* const row = rows[r];
      const double w = weights[r];
      for (std::size_t k = 0; k < columns; ++k) sum[k] += w * static_cast<double>(row[k]);
    }
    for (std::size_t k = 0; k < columns; ++k) mean[k] = static_cast<float>(sum[k] / weight);
    for (float* const row : rows)
      for (std::size_t k = 0; k < columns; ++k) row[k] -= mean[k];
  });
}

}  // namespace

/// Takes the weighted mean of every trace (apart in training and hold-out) out of all columns.
void BlockStatistics::centre_on_zeros(const std::vector<Groups>& groups) {
  std::map<int, std::vector<int>> traces;
  for (const int i : order_)
    if (problem_.zero[i] >= 0) traces[problem_.zero[i]].push_back(i);
  if (traces.empty()) return;
  centred_.conservativeResize(problem_.candidates.rows(), problem_.candidates.cols());
  struct Columns {
    Eigen::Index first, count;
  };
  std::vector<Columns> runs;
  for (const Groups& run : groups) {
    if (run.from == run.to) continue;
    const CandidateGroup& last = problem_.groups[run.to - 1];
    const int first = problem_.groups[run.from].first_column;
    runs.push_back({first, last.first_column + last.columns - first});
    centred_.middleCols(first, runs.back().count) =
        problem_.candidates.middleCols(first, runs.back().count);
  }
  std::vector<const std::vector<int>*> rows_of_traces;
  for (const auto& [trace, rows] : traces) rows_of_traces.push_back(&rows);
  // Traces do not ask each other: the same digits on any number of processors.
  constexpr std::size_t kAtOnce = 16;
  for_each_run(rows_of_traces.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    std::vector<double> weights, sums;
    std::vector<float> means;
    std::vector<float*> candidates;
    for (std::size_t t = from; t < to; ++t) {
      const std::vector<int>& rows = *rows_of_traces[t];
      double weight = 0.0, value = 0.0;
      Eigen::RowVectorXd model = Eigen::RowVectorXd::Zero(model_.cols());
      weights.clear();
      for (const int i : rows) {
        const double w = problem_.weight[i];
        weight += w;
        value += w * value_[i];
        model += w * model_.row(i);
        weights.push_back(w);
      }
      model /= weight;
      for (const int i : rows) {
        value_[i] -= value / weight;
        model_.row(i) -= model;
      }
      for (const Columns& run : runs) {
        candidates.clear();
        for (const int i : rows) candidates.push_back(centred_.row(i).data() + run.first);
        sums.resize(static_cast<std::size_t>(run.count));
        means.resize(sums.size());
        centre_rows(candidates, weights, weight, sums, means);
      }
    }
  });
}

void BlockStatistics::find_wholes() {
  if (problem_.whole.empty()) return;
  int before = -1;
  for (const int i : order_) {  // unit after unit
    if (problem_.unit[i] == before) continue;
    before = problem_.unit[i];
    if (problem_.whole[i] >= 0) wholes_[problem_.whole[i]].units.push_back(before);
  }
  int widest = 1;
  for (const CandidateGroup& group : problem_.groups) widest = std::max(widest, group.columns);
  if (wholes_.size() > kMostWholesAsked) return;
  for (auto& [number, whole] : wholes_)
    whole.products.assign(
        static_cast<std::size_t>(widest) * static_cast<std::size_t>(problem_.candidates.cols()), 0.0);
}

void BlockStatistics::sum_candidates(const std::vector<Groups>& groups) {
  std::map<int, double> trace_weight;
  for (const int i : order_) {
    const double w = problem_.weight[i], wy = w * value_[i];
    for (Sums* sums : {&unit_sums_[problem_.unit[i]], &fold_sums_[problem_.fold[i]], &all_}) {
      sums->value_value += wy * value_[i];
      sums->weight += w;
    }
    if (problem_.zero[i] >= 0) trace_weight[problem_.zero[i]] += w;
  }
  constexpr std::size_t kLeast = 32, kMost = 128;
  std::vector<Groups> pieces;
  for (const Groups& run : groups) {
    const std::size_t at_once = size_of_pieces(run.to - run.from, kLeast, kMost);
    for (std::size_t from = run.from; from < run.to; from += at_once)
      pieces.push_back({from, std::min(run.to, from + at_once)});
  }
  for_each_piece(pieces.size(), [&](std::size_t i) { sum_groups(pieces[i], trace_weight); });
}

namespace {

/// Sums of weighted products of columns that stand less than `apart` from each other, over the rows
/// of each fold.
class ColumnProducts {
 public:
  ColumnProducts(int folds, int columns, int apart)
      : columns_(static_cast<std::size_t>(columns)),
        apart_(static_cast<std::size_t>(apart)),
        sums_(static_cast<std::size_t>(folds + 1), std::vector<double>(apart_ * columns_, 0.0)),
        part_(apart_ * columns_, 0.0),
        row_(columns_),
        weighted_(columns_) {}

  /// Adds a row's products to those of its part, and `factor` times the row to two sums of rows.
  void add(const float* row, double weight, double factor, double* sum, double* other_sum) {
    double* const x = row_.data();
    double* const wx = weighted_.data();
    double* const products = part_.data();
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      for (std::size_t j = 0; j < columns_; ++j) {
        x[j] = row[j];
        wx[j] = weight * x[j];
      }
      for (std::size_t j = 0; j < columns_; ++j) sum[j] += factor * x[j];
      for (std::size_t j = 0; j < columns_; ++j) other_sum[j] += factor * x[j];
      for (std::size_t d = 0; d < apart_; ++d) {
        double* const beside = products + d * columns_;
        for (std::size_t j = 0; j < columns_ - d; ++j) beside[j] += wx[j] * x[j + d];
      }
    });
  }
  /// The part ends: its products belong to a fold, and to a whole whose rows of columns stand
  /// `stride` apart; nullptr: to none.
  void close_part(int fold, double* whole, std::size_t stride) {
    std::vector<double>& of_fold = sums_[static_cast<std::size_t>(fold)];
    for (std::size_t k = 0; k < part_.size(); ++k) of_fold[k] += part_[k];
    for (std::size_t d = 0; whole != nullptr && d < apart_; ++d)
      for (std::size_t j = 0; j < columns_; ++j) whole[d * stride + j] += part_[d * columns_ + j];
    std::fill(part_.begin(), part_.end(), 0.0);
  }
  /// Of column a with column b.
  [[nodiscard]] double sum(int fold, int a, int b) const {
    return sums_[static_cast<std::size_t>(fold)]
                [static_cast<std::size_t>(std::abs(b - a)) * columns_ +
                 static_cast<std::size_t>(std::min(a, b))];
  }

 private:
  std::size_t columns_, apart_;
  std::vector<std::vector<double>> sums_;
  std::vector<double> part_, row_, weighted_;
};

}  // namespace

/// Of the whole that a value belongs to, from a column on; nullptr where they are not summed.
double* BlockStatistics::products_of_whole(int value, int first_column) {
  const auto found = problem_.whole.empty() ? wholes_.end() : wholes_.find(problem_.whole[value]);
  if (found == wholes_.end() || found->second.products.empty()) return nullptr;
  return found->second.products.data() + first_column;
}

/// Sums of the columns of some groups, which stand beside each other.
void BlockStatistics::sum_groups(const Groups& run, const std::map<int, double>& trace_weight) {
  const auto& [from, to] = run;
  const CandidateMatrix& candidates = this->candidates();
  const std::vector<CandidateGroup>& groups = problem_.groups;
  const int first = groups[from].first_column;
  const int columns = groups[to - 1].first_column + groups[to - 1].columns - first;
  int widest = 1;
  for (std::size_t g = from; g < to; ++g) widest = std::max(widest, groups[g].columns);
  std::map<std::pair<int, int>, Eigen::VectorXd> trace_parts;
  double* trace_part = nullptr;  // of the value before
  std::pair<int, int> part_of;
  ColumnProducts products(folds_, columns, widest);
  for (std::size_t r = 0; r < order_.size(); ++r) {
    const int i = order_[r];
    const double w = problem_.weight[i], wy = w * value_[i];
    const int unit = problem_.unit[i], fold = problem_.fold[i];
    const float* row = candidates.row(i).data() + first;
    products.add(row, w, wy, unit_sums_[unit].candidate_value.data() + first,
                 fold_sums_[fold].candidate_value.data() + first);
    if (r + 1 == order_.size() || problem_.unit[order_[r + 1]] != unit ||
        problem_.fold[order_[r + 1]] != fold)
      products.close_part(fold, products_of_whole(i, first),
                          static_cast<std::size_t>(candidates.cols()));
    if (problem_.zero[i] < 0) continue;
    if (trace_part == nullptr || part_of != std::pair(problem_.zero[i], unit)) {
      part_of = {problem_.zero[i], unit};
      Eigen::VectorXd& sum = trace_parts[part_of];
      if (sum.size() == 0) sum = Eigen::VectorXd::Zero(columns);
      trace_part = sum.data();
    }
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      for (int k = 0; k < columns; ++k) trace_part[k] += w * static_cast<double>(row[k]);
    });
  }
  for (std::size_t g = from; g < to; ++g) {
    const CandidateGroup& group = groups[g];
    const int at = group.first_column - first;
    for (int fold = 0; fold <= folds_; ++fold)
      group_grams_[fold][g] = Eigen::MatrixXd::NullaryExpr(
          group.columns, group.columns, [&](Eigen::Index a, Eigen::Index b) {
            return products.sum(fold, at + static_cast<int>(a), at + static_cast<int>(b));
          });
    zero_loss_[g] = Eigen::MatrixXd::Zero(group.columns, group.columns);
    for (const auto& [key, part] : trace_parts) {
      const auto segment = part.segment(at, group.columns);
      zero_loss_[g] += segment * segment.transpose() / trace_weight.at(key.first);
    }
    for (int fold = 1; fold <= folds_; ++fold) group_grams_[0][g] += group_grams_[fold][g];
  }
  for (const Sums& sums : unit_sums_)
    all_.candidate_value.segment(first, columns) += sums.candidate_value.segment(first, columns);
}

int BlockStatistics::add_group(int group) {
  const CandidateGroup& added = problem_.groups[group];
  const int first = model_columns();
  model_.conservativeResize(Eigen::NoChange, first + added.columns);
  model_.rightCols(added.columns) =
      candidates().middleCols(added.first_column, added.columns).cast<double>();
  add_model_sums(first);
  return first;
}

/// Values of one unit within one fold, in the order of all.
struct BlockStatistics::Part {
  std::size_t begin = 0, end = 0;
  int unit = 0, fold = 0;
};

void BlockStatistics::add_model_sums(int first) {
  const int m = model_columns(), added = m - first;
  const auto p = candidates().cols();
  const auto grow = [&](Sums& sums) {
    sums.model_model.conservativeResize(m, m);
    sums.model_model.rightCols(added).setZero();
    sums.model_model.bottomRows(added).setZero();
    sums.model_value.conservativeResize(m);
    sums.model_value.tail(added).setZero();
  };
  for (Sums& sums : unit_sums_) grow(sums);
  for (Sums& sums : fold_sums_) grow(sums);
  grow(all_);
  for (Sums& sums : fold_sums_)
    sums.model_candidate.resize(static_cast<std::size_t>(m), Eigen::VectorXd::Zero(p));
  all_.model_candidate.resize(static_cast<std::size_t>(m), Eigen::VectorXd::Zero(p));
  unit_candidates_.resize(static_cast<std::size_t>(m));
  std::vector<std::vector<bool>> lacks;
  for (int k = first; k < m; ++k) lacks.push_back(take_kept(k));
  // One unit within one fold at a time, so that each value is added once.
  std::vector<Part> parts;
  for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
    const int unit = problem_.unit[order_[begin]], fold = problem_.fold[order_[begin]];
    Eigen::MatrixXd part_model = Eigen::MatrixXd::Zero(m, added);
    Eigen::VectorXd part_value = Eigen::VectorXd::Zero(added), row(m);
    for (; end < order_.size(); ++end) {
      const int i = order_[end];
      if (problem_.unit[i] != unit || problem_.fold[i] != fold) break;
      row = model_.row(i).transpose();  // (once: it stands in as many places as it has values)
      for (int k = 0; k < added; ++k) {
        const double a = problem_.weight[i] * row[first + k];
        part_model.col(k) += a * row;
        part_value[k] += a * value_[i];
      }
    }
    parts.push_back({begin, end, unit, fold});
    for (Sums* sums : {&unit_sums_[unit], &fold_sums_[fold], &all_}) {
      sums->model_model.rightCols(added) += part_model;
      sums->model_value.tail(added) += part_value;
    }
  }
  // Some panels at a time, so that what is read of a row of the candidates lies together.
  constexpr std::size_t kLeast = 2, kMost = 8;
  for_each_run(
      panels_.size(), size_of_pieces(panels_.size(), kLeast, kMost),
      [&](std::size_t from, std::size_t to) { add_candidate_sums(parts, first, lacks, from, to); });
  const auto mirror = [&](Sums& sums) {
    sums.model_model.bottomLeftCorner(added, first) =
        sums.model_model.topRightCorner(first, added).transpose();
  };
  for (Sums& sums : unit_sums_) mirror(sums);
  for (Sums& sums : fold_sums_) mirror(sums);
  mirror(all_);
}

namespace {

/// sum += of each row its factor times columns of single precision; `rows` point to the first of these.
void add_single_rows(PanelRow& sum, const double* factors, const float* const* rows,
                     std::size_t count) {
  // (left to itself, the compiler takes two rows at a time, column by column)
  using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
  using FourSingle [[gnu::vector_size(4 * sizeof(float))]] = float;
  constexpr std::size_t kFours = kPanelColumns / 4;
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    Four own[kFours];
    std::memcpy(own, sum.data(), sizeof own);
    for (std::size_t r = 0; r < count; ++r) {
      const double f = factors[r];
      const Four factor{f, f, f, f};
      for (std::size_t j = 0; j < kFours; ++j) {
        FourSingle row;
        std::memcpy(&row, rows[r] + 4 * j, sizeof row);
        own[j] += factor * __builtin_convertvector(row, Four);
      }
    }
    std::memcpy(sum.data(), own, sizeof own);
  });
}

}  // namespace

/// Where an earlier choice had the same column its sums are taken. The panels that it lacks, all where there is none:
/// their sums are zeros.
std::vector<bool> BlockStatistics::take_kept(int column) {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const KeptColumn& kept) {
    return kept.column == model_.col(column);
  });
  const auto k = static_cast<std::size_t>(column), units = static_cast<std::size_t>(units_);
  if (found == kept_.end()) {
    unit_candidates_[k].assign(panels_.size() * units, PanelRow{});
    return std::vector<bool>(panels_.size(), true);
  }
  const std::vector<bool> lacks = std::move(found->lacks);
  unit_candidates_[k] = std::move(found->of_units);
  unit_candidates_[k].resize(panels_.size() * units);
  for (std::size_t p = 0; p < panels_.size(); ++p)
    if (lacks[p]) std::fill_n(unit_candidates_[k].data() + p * units, units, PanelRow{});
  const auto take = [&](Eigen::VectorXd& sums, Eigen::VectorXd& kept) {
    sums = std::move(kept);
    sums.conservativeResize(candidates().cols());
    for (std::size_t p = 0; p < panels_.size(); ++p)
      if (lacks[p]) sums.segment(panels_[p].first_column, panels_[p].columns).setZero();
  };
  for (std::size_t fold = 0; fold < fold_sums_.size(); ++fold)
    take(fold_sums_[fold].model_candidate[k], found->of_folds[fold]);
  take(all_.model_candidate[k], found->of_all);
  kept_.erase(found);
  return lacks;
}

/// Products of the model columns from `first` on with those of some panels that they lack.
void BlockStatistics::add_candidate_sums(const std::vector<Part>& parts, int first,
                                         const std::vector<std::vector<bool>>& lacks,
                                         std::size_t from, std::size_t to) {
  const CandidateMatrix& candidates = this->candidates();
  const std::size_t added = lacks.size();
  std::vector<std::size_t> panels, columns;  // that are asked
  for (std::size_t p = from; p < to; ++p)
    if (std::any_of(lacks.begin(), lacks.end(), [&](const auto& column) { return column[p]; }))
      panels.push_back(p);
  for (std::size_t k = 0; k < added; ++k)
    if (std::any_of(panels.begin(), panels.end(), [&](std::size_t p) { return lacks[k][p]; }))
      columns.push_back(k);
  if (panels.empty()) return;
  std::vector<double> factors;
  std::vector<const float*> rows;
  std::vector<std::array<float, kPanelColumns>> copies;
  for (const Part& part : parts) {
    const std::size_t count = part.end - part.begin;
    factors.resize(count * added);
    for (std::size_t r = 0; r < count; ++r) {
      const int i = order_[part.begin + r];
      for (const std::size_t k : columns)
        factors[k * count + r] = problem_.weight[i] * model_(i, first + static_cast<int>(k));
    }
    for (const std::size_t p : panels) {
      const PanelColumns& panel = panels_[p];
      const auto used = static_cast<std::size_t>(panel.columns);
      rows.resize(count);
      for (std::size_t r = 0; r < count; ++r)
        rows[r] = candidates.row(order_[part.begin + r]).data() + panel.first_column;
      // Of a panel that is not full a row goes on with what is no part of it.
      if (used < kPanelColumns) {
        copies.assign(count, {});
        for (std::size_t r = 0; r < count; ++r)
          rows[r] = std::copy_n(rows[r], used, copies[r].begin()) - used;
      }
      for (const std::size_t k : columns) {
        if (!lacks[k][p]) continue;
        PanelRow sum{};
        add_single_rows(sum, factors.data() + k * count, rows.data(), count);
        const std::size_t column = static_cast<std::size_t>(first) + k;
        PanelRow& of_unit = unit_candidates_[column][p * static_cast<std::size_t>(units_) +
                                                     static_cast<std::size_t>(part.unit)];
        for (std::size_t j = 0; j < kPanelColumns; ++j) of_unit[j] += sum[j];
        const Eigen::Map<const Eigen::VectorXd> of_panel(sum.data(), panel.columns);
        fold_sums_[part.fold].model_candidate[column].segment(panel.first_column, panel.columns) +=
            of_panel;
        all_.model_candidate[column].segment(panel.first_column, panel.columns) += of_panel;
      }
    }
  }
}

}  // namespace trueflank::loop
