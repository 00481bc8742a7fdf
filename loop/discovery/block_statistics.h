// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "trueflank/loop/discovery/column_panels.h"
#include "trueflank/loop/discovery/discovery.h"

namespace trueflank::loop {

/// So few whole traces or flanks are asked whether they agree (agreement.h).
constexpr std::size_t kFewestWholesAsked = 4, kMostWholesAsked = 96;

/// Normal equations of a discovery problem, kept per unit and per fold so that no step of the
/// selection has to walk the values again. Model columns are the nuisance columns and every group
/// that was ever added.
class BlockStatistics {
 public:
  explicit BlockStatistics(const DiscoveryProblem& problem);
  /// With the sums of an earlier choice on the same values, weights, units and folds: the columns of groups that
  /// `stayed` are those they were. The same numbers as made anew.
  BlockStatistics(const DiscoveryProblem& problem, BlockStatistics&& earlier,
                  const std::vector<bool>& stayed);

  /// About what it takes of memory.
  [[nodiscard]] std::size_t bytes() const;

  /// Makes a group's columns model columns; returns the first of them. One pass over the values.
  int add_group(int group);

  /// @name Values used, and what is fitted to them, less the weighted mean of each trace's zero
  /// @{
  [[nodiscard]] const std::vector<int>& used() const { return order_; }
  [[nodiscard]] const Eigen::VectorXd& value() const { return value_; }
  [[nodiscard]] const Eigen::MatrixXd& model() const { return model_; }
  [[nodiscard]] const CandidateMatrix& candidates() const {
    return centred_.size() > 0 ? centred_ : problem_.candidates;
  }
  /// @}
  [[nodiscard]] int model_columns() const { return static_cast<int>(model_.cols()); }
  [[nodiscard]] int units() const { return units_; }
  [[nodiscard]] int folds() const { return folds_; }
  [[nodiscard]] double total_weight() const { return total_weight_; }

  /// Sums over one unit or fold; M model columns, P candidates.
  struct Sums {
    Eigen::MatrixXd model_model;  ///< M x M
    Eigen::VectorXd model_value;  ///< M
    /// M of P: a model column with every candidate; of folds and all, not of units
    std::vector<Eigen::VectorXd> model_candidate;
    Eigen::VectorXd candidate_value;  ///< P
    double value_value = 0.0;
    double weight = 0.0;
  };
  [[nodiscard]] const Sums& unit(int i) const { return unit_sums_[i]; }
  /// 1 ... folds().
  [[nodiscard]] const Sums& fold(int i) const { return fold_sums_[i]; }
  [[nodiscard]] const Sums& all() const { return all_; }
  [[nodiscard]] const std::vector<PanelColumns>& panels() const { return panels_; }
  /// Sums of a model column with the candidates of a panel over a unit; those of the next unit
  /// follow.
  [[nodiscard]] const PanelRow& unit_candidates(int model_column, std::size_t panel,
                                                int unit) const {
    return unit_candidates_[static_cast<std::size_t>(
        model_column)][panel * static_cast<std::size_t>(units_) + static_cast<std::size_t>(unit)];
  }
  /// One whole trace or flank: its units, and of the candidates' columns the weighted products of
  /// those that stand 0, 1, ... apart (at d * columns + the first of the two). Summed for as many
  /// wholes as agreement.h asks of.
  struct Whole {
    std::vector<int> units;
    std::vector<double> products;
  };
  /// By their numbers, where values of one unit are of one whole.
  [[nodiscard]] const std::map<int, Whole>& wholes() const { return wholes_; }
  /// Variance that slow candidates meet within a whole that is asked (agreement.h); 0 where none is.
  [[nodiscard]] double scatter_within() const { return scatter_within_; }
  /// Gram matrix of a group, over a fold (1 ...) or over all (0).
  [[nodiscard]] const Eigen::MatrixXd& group_gram(int group, int fold) const {
    return group_grams_[fold][group];
  }
  /// What a free zero takes from a group's spread under sign flips of parts of its trace.
  [[nodiscard]] const Eigen::MatrixXd& zero_loss(int group) const { return zero_loss_[group]; }

 private:
  /// Neighbouring groups, from one to before another.
  struct Groups {
    std::size_t from, to;
  };
  /// Sums of a model column of an earlier choice; not with panels that are others since then.
  struct KeptColumn {
    Eigen::VectorXd column;
    std::vector<PanelRow> of_units;
    std::vector<Eigen::VectorXd> of_folds;
    Eigen::VectorXd of_all;
    std::vector<bool> lacks;  ///< per panel
  };
  void order_values();
  void sum_up(const std::vector<Groups>& groups);
  void take_sums_of(BlockStatistics& earlier, const std::vector<bool>& stayed);
  void take_sums_of_columns(BlockStatistics& earlier, const Groups& groups);
  [[nodiscard]] std::size_t bytes_of_column() const;
  void keep_columns_of(BlockStatistics& earlier, const std::vector<bool>& stayed);
  void centre_on_zeros(const std::vector<Groups>& groups);
  void clear_sums();
  void find_wholes();
  double* products_of_whole(int value, int first_column);
  void sum_candidates(const std::vector<Groups>& groups);
  void sum_groups(const Groups& groups, const std::map<int, double>& trace_weight);
  void add_model_sums(int first);
  [[nodiscard]] std::vector<bool> take_kept(int column);
  struct Part;
  void add_candidate_sums(const std::vector<Part>& parts, int first,
                          const std::vector<std::vector<bool>>& lacks, std::size_t from,
                          std::size_t to);

  const DiscoveryProblem& problem_;
  CandidateMatrix centred_;  ///< the candidates less their zeros; empty: there are none
  Eigen::VectorXd value_;
  Eigen::MatrixXd model_;
  std::vector<int> order_;  ///< values used, sorted by unit and fold
  int units_ = 0, folds_ = 0;
  double total_weight_ = 0.0;
  std::vector<Sums> unit_sums_, fold_sums_;
  std::vector<PanelColumns> panels_;
  std::vector<std::vector<PanelRow>>
      unit_candidates_;  ///< of model columns: panel after panel, in it the units
  Sums all_;
  std::map<int, Whole> wholes_;
  double scatter_within_ = 0.0;
  std::vector<std::vector<Eigen::MatrixXd>> group_grams_;
  std::vector<Eigen::MatrixXd> zero_loss_;
  std::vector<KeptColumn> kept_;  ///< those that were not asked for yet, the latest first
};

}  // namespace trueflank::loop
