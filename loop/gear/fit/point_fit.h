// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// True for values that error figures are made of: flank points, traces, index, radial, sizes; not
/// tips and bores of scans, which only help to tell effects apart.
[[nodiscard]] bool counts_as_error(ObservationKind kind);

/// What a fit is to: the table as it stands, or the deviations of the gear as designed.
enum class DeviationsOf : std::uint8_t { kTable, kDesign };

/// Joint least squares of effects and nuisance on the single values, with the patches' weights.
/// Linear in the values: one pass on all processors gathers normal equations per unit, the same
/// ones on any number of them. With a stride only every n-th value is used.
class PointFit {
 public:
  /// Other fits to the same values: columns that they have are not computed again.
  using Known = std::span<const std::shared_ptr<const PointFit>>;
  PointFit(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
           std::vector<Effect> effects, std::size_t stride = 1,
           DeviationsOf what = DeviationsOf::kTable, Known known = {});

  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }
  [[nodiscard]] int first_column(int effect) const { return first_column_[effect]; }

  struct Errors {
    double rms_um = 0.0, held_out_rms_um = 0.0;
  };
  /// Errors with some effects left out (and all else refitted): held-out ones from a fit to the
  /// training part, the others from a fit to all.
  [[nodiscard]] Errors errors(const std::vector<bool>& with_effect) const;
  /// The error on held-out values with all effects, what only held-out values show (a form of one
  /// held-out tooth) fitted there: what the others leave. And the effects of which that is so.
  struct HeldOutBesideLocal {
    double rms_um = kNaN;
    std::vector<std::size_t> fitted_there;
  };
  [[nodiscard]] HeldOutBesideLocal held_out_beside_local() const;
  /// Error [um] with the effects' coefficients given (in the order of columns, the nuisance left
  /// out) and only the nuisance fitted: what a model learnt elsewhere leaves here.
  [[nodiscard]] double rms_with_um(const Eigen::VectorXd& effect_coefficients) const;
  /// Share of a column that is left beside all others: 0 where these data cannot show it.
  [[nodiscard]] double retained(int column) const { return retained_[column]; }
  /// Root mean square of a column over the values [um a unit of its coefficient].
  [[nodiscard]] double column_size(int column) const;
  /// Root mean square of what an effect adds to the values [um].
  [[nodiscard]] double effect_size_um(int effect) const;
  /// True where profile and helix traces are all that was measured.
  [[nodiscard]] bool is_of_traces_alone() const;
  /// The same of several together, less what the pose takes up of it.
  [[nodiscard]] double size_beside_pose_um(const std::vector<int>& effects) const;

  /// Coefficients of the fit to all data, effects' columns in order after the nuisance.
  [[nodiscard]] const Eigen::VectorXd& coefficients() const { return coefficients_; }
  /// Covariance by leaving out one unit after the other; of columns that live in one or two units
  /// by the spread of the other units' means.
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// Units that bear on a column, as degrees of freedom.
  [[nodiscard]] double degrees(int column) const { return degrees_[column]; }
  /// Standard deviation of the random error: residual over the degrees of freedom left.
  [[nodiscard]] double noise_um() const { return noise_um_; }
  /// Weighted residual square of the fit to all.
  [[nodiscard]] double residual_square() const { return residual_square_; }
  /// The same with some effects left out and all else refitted.
  [[nodiscard]] double residual_square(const std::vector<bool>& with_effect) const;

  /// Residual of every row [um] as fitted with all effects. Asked for again, they are the same as
  /// long as the fit, or somebody else, holds them.
  [[nodiscard]] std::shared_ptr<const std::vector<float>> residuals_um() const;
  /// Leaves it to others to hold them: they take memory for every row.
  void forget_residuals() const { kept_residuals_um_.reset(); }
  /// The same with none of the effects.
  [[nodiscard]] std::vector<float> residuals_without_effects_um() const;

  [[nodiscard]] int observations() const { return observations_; }
  [[nodiscard]] int held_out() const { return held_out_; }

 private:
  void keep_features(Known known);
  /// Columns beside each other that another fit keeps.
  struct KeptColumns {
    const double* from = nullptr;  ///< in its first row
    std::size_t width = 0;         ///< of its rows
    int to = 0, count = 0;
  };
  [[nodiscard]] bool is_in_known(std::size_t effect, Known known,
                                 std::vector<KeptColumns>& taken) const;
  void features(std::size_t row, double* values, std::size_t effects) const;
  void features_at(const Place& place, const Observation& row, double* values,
                   std::size_t effects) const;
  void features_of(const PlacedPoint& placed, const Observation& row, double* values,
                   std::size_t effects) const;
  [[nodiscard]] bool as_it_was(std::size_t row) const;
  [[nodiscard]] std::vector<float> residuals_with(const Eigen::VectorXd& coefficients) const;
  void average_zeros();
  struct PatchOfRow;
  struct RowPanel;
  struct Sums;
  struct ZerosOfPieces;
  [[nodiscard]] Sums sums_of(const std::vector<PatchOfRow>& patches, std::size_t begin,
                             std::size_t end) const;
  void accumulate();
  void solve();
  [[nodiscard]] bool few_units_bear(int k);
  void spread_between_units(const Eigen::MatrixXd& normal);
  void spread_beside(int k, double normal, double inverse);
  [[nodiscard]] Eigen::VectorXd solution(const Eigen::MatrixXd& gram,
                                         const std::vector<int>& columns) const;
  [[nodiscard]] std::vector<int> columns_with(const std::vector<bool>& with_effect) const;
  void fit_pose(const Eigen::VectorXd& values, Eigen::VectorXd& b) const;
  [[nodiscard]] bool is_hardly_learnt(std::size_t effect) const;
  [[nodiscard]] std::vector<int> learnt(std::vector<int> columns) const;

  const FlankGeometry& geometry_;
  const Observations& table_;
  const Patches& patches_;
  std::size_t stride_;
  DeviationsOf what_;
  NuisanceColumns nuisance_;
  std::vector<Effect> effects_;
  std::vector<PreparedEffect> prepared_;  ///< the same
  std::vector<int> first_column_;
  int columns_ = 0;
  std::vector<double> kept_;  ///< features of all rows, one after the other; empty: they are computed anew
  std::vector<Eigen::VectorXd> zero_means_;  ///< per trace, training and held-out apart
  std::vector<Eigen::VectorXd> whole_zero_means_;
  std::vector<Eigen::MatrixXd> unit_grams_;  ///< last row and column: the values
  std::vector<int> unit_kind_,
      unit_zero_;  ///< kind of record; the trace of whose zero it has a share, or -1
  std::vector<Eigen::VectorXd> unit_sums_;  ///< weighted sums of all columns, the weight last
  Eigen::MatrixXd train_, all_, plain_held_, plain_all_;
  Eigen::VectorXd coefficients_;
  Eigen::MatrixXd covariance_;
  std::vector<double> degrees_, retained_;
  mutable std::weak_ptr<const std::vector<float>> residuals_um_;
  mutable std::shared_ptr<const std::vector<float>> kept_residuals_um_;
  double noise_um_ = 0.0, residual_square_ = 0.0;
  int observations_ = 0, held_out_ = 0, zeros_ = 0;
};

}  // namespace trueflank::loop
