// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "trueflank/loop/discovery/block_statistics.h"

namespace trueflank::loop {

/// Candidates less what the columns of a model take of them, seen by the sums over units and wholes:
/// what tests of structure ask. A column more costs some sums over the model's columns for each
/// candidate and unit; a choice adds one after the other.
///
/// The model's columns stand as orthonormal ones q, in the order in which they came. With the
/// coefficients a = q'c of a candidate c, what is left of it becomes c - a q, and what is left of the
/// value r - b q. Of a unit u and the part d = (q'c)_u of its own, everything follows from sums: scores
/// (c'r)_u lose a (q'r)_u + b d - a b (q'q)_u, products of candidates in a whole a d' + d a' - a a' (q'q).
/// What flips lose to the columns, the squares of all o = (q_k'c)_u, changes by those of d - a (q'q)_u and, as
/// each earlier o loses a h with h = (q_k'q)_u, by -2 a s + a^2 h'h with s = h'o: one more sum a unit,
/// not one for each earlier column.
class ProjectedCandidates {
 public:
  /// Beside no column. Of panels with banned and local groups alone only scores() and gram() are kept.
  ProjectedCandidates(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                      const std::vector<bool>& banned);

  /// Beside these columns of the model. Where the first of them are those it stands beside, the others are
  /// added; else it begins anew.
  void put_beside(const std::vector<int>& columns);
  /// How many columns it stands beside; those that say nothing beside earlier ones count, too.
  [[nodiscard]] std::size_t fitted() const { return columns_.size(); }

  /// P: products with what is left of the value.
  [[nodiscard]] const Eigen::VectorXd& scores() const { return scores_; }
  /// P x units: the same of each unit.
  [[nodiscard]] const Eigen::MatrixXd& unit_scores() const { return unit_scores_; }
  /// Gram matrix of a group.
  [[nodiscard]] Eigen::MatrixXd gram(int group) const;
  /// What the columns take of it, in the mean of sign flips of units.
  [[nodiscard]] Eigen::MatrixXd lost_by_flips(int group) const;

  /// True for a panel of which units and wholes are kept.
  [[nodiscard]] bool is_asked(std::size_t panel) const { return panels_[panel].asked; }
  /// Of a panel and a whole (in the order of BlockStatistics::wholes()): products of columns that stand 0, 1, ...
  /// apart. Of as many wholes as are asked (agreement.h).
  [[nodiscard]] const PanelRow* products_of_whole(std::size_t panel, std::size_t whole) const {
    return panels_[panel].of_wholes.data() + whole * panels_[panel].gram.size();
  }

 private:
  struct Added;
  struct OfPanel {
    bool asked = false;
    std::vector<PanelRow> gram, lost;  ///< of columns that stand 0, 1, ... apart
    Panel taken;                       ///< a row a column q: a
    std::vector<PanelRow> of_wholes;
  };
  void begin();
  void begin_panel(std::size_t panel);
  [[nodiscard]] std::optional<Added> add_column(int column);
  [[nodiscard]] Added prepared(const std::vector<int>& columns, const Eigen::VectorXd& own) const;
  void add_to_panel(std::size_t panel, const Added& added);
  void add_to_units(std::size_t panel, const Added& added, PanelRow& taken);
  [[nodiscard]] Eigen::MatrixXd of_group(int group, std::vector<PanelRow> OfPanel::*rows) const;

  const DiscoveryProblem& problem_;
  const BlockStatistics& statistics_;
  std::vector<bool> asked_;            ///< per panel
  std::vector<std::size_t> panel_of_;  ///< per group
  std::vector<int> columns_;           ///< all it stands beside
  std::vector<int> own_columns_;       ///< those that said something
  Eigen::MatrixXd basis_;  ///< coefficients of the orthonormal columns on those, a column each
  Eigen::VectorXd value_;  ///< b of each
  Eigen::VectorXd scores_;
  Eigen::MatrixXd unit_scores_;
  std::vector<OfPanel> panels_;
};

}  // namespace trueflank::loop
