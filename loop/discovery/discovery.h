// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

// The engine of the loop: finds which of many candidate effects a residual holds. It knows nothing
// of gears or drives: only values, nuisance columns, candidate columns and which values may share
// their random error.
namespace trueflank::loop {

using CandidateMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class KeptSums;

/// Columns that enter a model together.
struct CandidateGroup {
  int first_column = 0;
  int columns = 1;
  int preference = 0;      ///< of candidates that explain equally well the one with the lowest wins
  /// Groups of one family that each live in one unit (one tooth) are judged against each other.
  int local_family = -1;   ///< -1: not local
  int kin = -1;            ///< groups that are one effect at other shape parameters; -1: none
  bool named = true;       ///< false: free form, which is given no cause
  double complexity = 0.0; ///< of candidates of one preference and size the simplest wins
};

struct DiscoveryProblem {
  Eigen::VectorXd value;            ///< n
  Eigen::VectorXd weight;           ///< n, inverse variances up to one common factor
  Eigen::MatrixXd nuisance;         ///< n x m: fitted in every model
  CandidateMatrix candidates;       ///< n x p
  std::vector<CandidateGroup> groups;
  std::vector<int> unit;            ///< n: values of different units have independent errors
  std::vector<int> fold;            ///< n: 0 locked hold-out, never touched; 1 ... K cross-validation
  /// Fold of single values of known error (a diameter) that judge all candidates, by chi-square, but
  /// take no part in standard errors; -1: none.
  int anchor_fold = -1;
  std::vector<int> zero;            ///< n: values that share an unknown constant; -1: none
  /// n: values of one trace or flank, whose parts may be units; -1: none. Empty: none at all.
  std::vector<int> whole;
  /// Where choices are made again: sums over the candidates that stayed. nullptr: all are made anew.
  std::shared_ptr<KeptSums> kept;
};

struct DiscoveryOptions {
  double first_level = 0.01;   ///< false alarm rate of the first test of structure
  double next_level = 0.01;    ///< of the tests once something was found
  double local_level = 0.002;  ///< of effects that live in one unit
  int flips = 799;
  int most_effects = 12;
  std::vector<bool> banned;    ///< groups not to choose; empty: none
};

struct ChosenGroup {
  int group = 0;
  double p_value = 1.0;        ///< of the step that chose it, corrected for all candidates tried
  double gain = 0.0;           ///< squared error saved in cross-validation, over the total weight
  double gain_error = 0.0;     ///< standard error of it
  double bic_gain = 0.0;       ///< > 0: BIC would add it too
  std::vector<int> confounded; ///< groups whose columns do the same after projection
};

struct DiscoveryResult {
  double first_p_value = 1.0;  ///< of any structure at all
  double first_common_p_value = 1.0;  ///< of structure that does not live in one unit
  std::vector<ChosenGroup> chosen;
  double p_left = 1.0;         ///< of structure beyond the chosen effects
  int most_likely_left = -1;        ///< group most like what is left
  std::vector<bool> observable; ///< per group: not absorbed by the nuisance columns
};

/// Forward selection with joint refit.
/// Test of structure: sign flips of whole units, the largest group statistic against the largest of
/// every flip (each flip makes a decoy of every candidate), each group scaled by its own flips, so that
/// correlation within a unit costs power, not validity. Of few traces or flanks, whose signs are soon all
/// tried, also how much they agree: an F test of each group over whole traces (agreement.h). Choice:
/// cross-validated error over folds; of candidates within one standard error of the best the one preferred;
/// then replacement, merging of two into one, and removal of what does not earn one standard error.
/// Errors of units must be symmetric and independent; nothing else is assumed.
[[nodiscard]] DiscoveryResult discover(const DiscoveryProblem& problem,
                                       const DiscoveryOptions& options);

/// The same in two steps: of a choice that is made again nobody asks what it leaves.
class Discovery {
 public:
  /// Chooses. The problem but for its nuisance columns must stay as it is until finished() was asked.
  Discovery(const DiscoveryProblem& problem, const DiscoveryOptions& options);
  Discovery(Discovery&&) noexcept;
  Discovery& operator=(Discovery&&) noexcept;
  ~Discovery();

  /// Without what is confounded, BIC's gain and the test of what is left.
  [[nodiscard]] const DiscoveryResult& chosen() const;
  [[nodiscard]] DiscoveryResult finished() &&;

 private:
  class Selection;
  std::unique_ptr<Selection> selection_;
};

}  // namespace trueflank::loop
