// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/fit/trial_fit.h"

namespace trueflank::loop {

/// The fit in which shapes are refined.
[[nodiscard]] TrialFit fit_to_refine(const FlankGeometry& geometry, const SharedTable& table,
                                     const Patches& patches, const std::vector<Effect>& effects);
/// True where that takes all rows of a table, not some of them.
[[nodiscard]] bool is_refined_by_all_rows(const Observations& table);
/// True where any has a shape that moves: for refine_shapes from the first on, for refine_nearby any.
[[nodiscard]] bool can_be_refined(const std::vector<Effect>& effects, std::size_t first);

/// Moves the continuous shapes (heights, diameters, widths) of chosen effects from the grid they were
/// chosen on to the best fit: Gauss-Newton jointly with all coefficients, a step's height by trial.
/// Those before the first stay as they are.
void refine_shapes(const FlankGeometry& geometry, std::size_t first, TrialFit& fit);
void refine_shapes(const FlankGeometry& geometry, const SharedTable& table, const Patches& patches,
                   std::vector<Effect>& effects, std::size_t first = 0);

/// Least share of a column that must be left beside all others: two waves of nearly one length
/// that fit with large sizes of opposite signs describe nothing.
inline constexpr double kToldApart = 0.1;

/// Moves places and orders that were found on patches, or without the hold-out, to those beside them
/// (EffectFamily::nearby) that fit the single values better and are told apart from all others.
/// True where any moved.
bool refine_nearby(const FlankGeometry& geometry, TrialFit& fit);
/// The same, and where no step is better to between two of them: places and widths of narrow forms
/// lie closer together than the steps.
bool refine_between_steps(const FlankGeometry& geometry, TrialFit& fit);
bool refine_nearby(const FlankGeometry& geometry, const SharedTable& table, const Patches& patches,
                   std::vector<Effect>& effects);

/// Uncertainty of a fit with what the shapes add to it.
struct ShapeUncertainty {
  /// Standard error of every shape value of every effect; NaN for fixed ones. For the height of a step
  /// the resolution it was searched with.
  std::vector<std::vector<double>> errors;
  /// Covariance of the fit's coefficients with the shapes free too, in the fit's order of columns.
  Eigen::MatrixXd covariance;
  /// By how much coefficients are others where the same is told another way: intervals hold both.
  /// Empty: there is none.
  Eigen::VectorXd otherwise;
};
/// Which shapes count as free: those that are refined with the coefficients, or the places and
/// widths of forms without a name too.
enum class FreeShapes : std::uint8_t { kRefined, kAll };
[[nodiscard]] ShapeUncertainty shape_uncertainty(const FlankGeometry& geometry,
                                                 const Observations& table, const Patches& patches,
                                                 const PointFit& fit,
                                                 FreeShapes free = FreeShapes::kRefined);

/// Moves one effect's place and widths to where clearly less is left, all else being where it is,
/// and tells what is left (chi-square).
double move_alone(const FlankGeometry& geometry, const TrialFit& fit, std::size_t effect,
                  EffectShape& shape);

}  // namespace trueflank::loop
