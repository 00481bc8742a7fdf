// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "trueflank/loop/discovery/projected_candidates.h"

namespace trueflank::loop {

/// Scores of a candidate's columns under sign flips: a row a column, a column a flip.
using FlipScores = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Does the residual of a model hold structure of the candidates' kinds? Sign flips of whole units:
/// under no structure the scores of independent, symmetric errors are as likely with any signs.
/// Source: Hemerik, Goeman, Finos 2020, doi 10.1111/rssb.12369 (sign flips of effective scores),
/// here with the mean spread each group loses to the fitted columns put back. Of few traces or
/// flanks all signs are soon tried: candidates that differ between them fit any signs. There
/// whether they agree is asked, too: an F test (agreement.h) with Bonferroni's correction.
class StructureTest {
 public:
  /// Candidates beside the model's columns.
  StructureTest(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                const ProjectedCandidates& beside, int flips, const std::vector<bool>& banned);

  /// Of any structure, corrected for all candidates.
  [[nodiscard]] double p_value() const { return p_value_; }
  /// Of one group, corrected for all candidates; 1 where it cannot be tested.
  [[nodiscard]] double p_value_of(int group) const { return group_p_values_[group]; }
  [[nodiscard]] int most_likely() const { return most_likely_; }
  /// chi-square p of the most likely group alone, uncorrected: for comparison with the local ones.
  [[nodiscard]] double most_likely_single_p_value() const { return most_likely_single_p_value_; }
  /// Of one local group standing out of its family, corrected for all local groups.
  [[nodiscard]] double local_p_value() const { return local_p_value_; }
  [[nodiscard]] int most_likely_local() const { return most_likely_local_; }
  [[nodiscard]] const std::vector<bool>& observable() const { return observable_; }

 private:
  void judge_what_can_be_seen();
  void test_by_flips(int flips);
  /// Of all groups with so many columns, the largest statistic of each flip: the tail falls with
  /// the statistic, so that one has it.
  using LargestOfSize = std::map<int, Eigen::VectorXd>;
  [[nodiscard]] double judge_under_flips(std::size_t g, const Eigen::Ref<const FlipScores>& scores,
                                         LargestOfSize& largest) const;
  void compare_with_flips(const std::vector<double>& own, const LargestOfSize& largest_of_size,
                          int flips);
  void test_wholes(const std::vector<bool>& banned);
  void test_local(const std::vector<bool>& banned);
  void test_two_that_hide_each_other(const std::vector<int>& members,
                                     const std::vector<double>& score, double families);

  const DiscoveryProblem& problem_;
  const BlockStatistics& statistics_;
  const ProjectedCandidates& beside_;
  std::vector<bool> asked_;  ///< per group: flips judge it, as neither local nor banned
  std::vector<Eigen::MatrixXd> projected_;  ///< per group: Gram matrix after projection
  std::vector<Eigen::MatrixXd> flipped_;    ///< per group asked: mean Gram matrix under flips
  std::vector<bool> observable_, testable_;
  std::vector<double> group_p_values_;
  double p_value_ = 1.0, local_p_value_ = 1.0, most_likely_single_p_value_ = 1.0;
  int most_likely_ = -1, most_likely_local_ = -1;
};

}  // namespace trueflank::loop
