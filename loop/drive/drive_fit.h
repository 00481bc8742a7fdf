// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/discovery.h"
#include "trueflank/loop/drive/drive_effect.h"

namespace trueflank::loop {

/// Which rows a fit may see.
enum class FitRows { kTraining, kAll };

/// Joint weighted least squares of chosen effects on the rows of a bench.
class DriveFit {
 public:
  /// `value`: measured less designed driven torque [N m] of every point.
  DriveFit(const DriveContext& context, const Eigen::VectorXd& value,
           std::vector<DriveEffect> effects, FitRows rows);
  /// With the columns of a fit in the same context where effects are the same as in it.
  DriveFit(const DriveFit& known, std::vector<DriveEffect> effects);

  [[nodiscard]] const DriveContext& context() const { return context_; }
  [[nodiscard]] const std::vector<DriveEffect>& effects() const { return effects_; }
  [[nodiscard]] int first_column(int effect) const { return first_column_[effect]; }
  [[nodiscard]] const Eigen::VectorXd& coefficients() const { return coefficients_; }
  [[nodiscard]] double residual_square() const { return residual_square_; }
  /// False where an amount cannot be what it is called: of one effect, of any.
  [[nodiscard]] bool can_be(int effect) const {
    return effects_[effect].can_be(context_.model, coefficients_[first_column_[effect]]);
  }
  [[nodiscard]] bool can_be() const {
    for (int e = 0; e < static_cast<int>(effects_.size()); ++e)
      if (!can_be(e)) return false;
    return true;
  }
  /// What the effects add to the driven torque of every point [N m].
  [[nodiscard]] Eigen::VectorXd explained_nm() const { return columns_ * coefficients_; }
  [[nodiscard]] Eigen::VectorXd explained_nm(int effect) const;

  /// Coefficients of this fit's rows with some effects left out; zeros for those.
  [[nodiscard]] Eigen::VectorXd without(const std::vector<bool>& left_out) const;
  [[nodiscard]] const Eigen::MatrixXd& columns() const { return columns_; }

  /// Weighted squared error on each of the folds 1 ... 8, fitted to the others.
  [[nodiscard]] Eigen::VectorXd fold_errors() const;

  /// Covariance of coefficients, then of the continuous shape values in order, by leaving out one unit
  /// after the other.
  [[nodiscard]] Eigen::MatrixXd covariance() const;
  /// Column of a shape value in the covariance; -1: fixed.
  [[nodiscard]] int shape_column(int effect, int value) const { return shape_column_[effect][value]; }
  /// Friction and scale at these coefficients.
  [[nodiscard]] DriveState state_at(const Eigen::VectorXd& coefficients) const;
  /// Units less what was fitted.
  [[nodiscard]] double degrees() const;

 private:
  DriveFit(const DriveContext& context, const Eigen::VectorXd& value,
           std::vector<DriveEffect> effects, FitRows rows, const DriveFit* known);
  void fill_columns(const DriveFit* known);
  [[nodiscard]] Eigen::MatrixXd shape_slopes() const;
  /// Change of the explained torque per unit of every coefficient. A friction's column is the secant
  /// from the design, and moves with it: efficiencies bend.
  [[nodiscard]] Eigen::MatrixXd coefficient_slopes() const;
  [[nodiscard]] bool sees(int point) const;

  const DriveContext& context_;
  const Eigen::VectorXd& value_;
  std::vector<DriveEffect> effects_;
  FitRows rows_;
  std::vector<int> first_column_;
  std::vector<std::vector<int>> shape_column_;
  int shapes_ = 0;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd weight_;  ///< 0 for rows not seen
  Eigen::VectorXd coefficients_;
  double residual_square_ = 0.0;
};

/// Moves the continuous shapes of effects to the least squares of the rows seen.
void refine_drive_shapes(const DriveContext& context, const Eigen::VectorXd& value, FitRows rows,
                         std::vector<DriveEffect>& effects);

/// The same effects, of which those that are there at times and at times not are so in the rows
/// that are locked away too: when it is there nothing foretells. Amounts stay the training's.
[[nodiscard]] std::vector<DriveEffect> with_states_of_all_rows(const DriveContext& context,
                                                               const Eigen::VectorXd& value,
                                                               std::vector<DriveEffect> effects);

/// The engine's problem for the candidates of a bench. Columns that neither state nor shape changed since
/// are kept.
class DriveProblem {
 public:
  [[nodiscard]] const DiscoveryProblem& made_for(const DriveContext& context,
                                                 const Eigen::VectorXd& value,
                                                 const std::vector<DriveEffect>& candidates);

 private:
  /// The groups' columns that must be computed.
  [[nodiscard]] std::vector<std::size_t> changed(const DriveState& state,
                                                 const std::vector<DriveEffect>& candidates) const;
  void lay_out(const DriveContext& context, const Eigen::VectorXd& value);
  void fill(const DriveContext& context, const std::vector<std::size_t>& groups);

  DiscoveryProblem problem_;
  std::vector<DriveEffect> candidates_;
  DriveState state_;
};

}  // namespace trueflank::loop
