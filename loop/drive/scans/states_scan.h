// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/drive/drive_effect.h"
#include "trueflank/loop/drive/drive_fit.h"

// Two states between which a drive changes to and fro at no regular times.
namespace trueflank::loop {

/// The likeliest two levels of a loss, a friction or a zero of the output's torque, and when which
/// of them was there.
struct LikeliestStates {
  double p_value = 1.0;  ///< of levels so far apart in noise, over all ways to cut the run
  double what = 0.0;     ///< drive_effects::What
  std::vector<double>
      changes;          ///< 0 ... 1 of the run: begins at the first, ends at the second, ...
  double square = 0.0;  ///< what the training leaves about the levels, in the noise's units
};
/// `left` [N m] of every row. Requires: rows of one file in their order. Errors that hang together
/// inside the states, or levels that are not apart, leave a p-value of 1 and the likeliest changes.
[[nodiscard]] LikeliestStates likeliest_states(const DriveContext& context,
                                               const Eigen::VectorXd& left);

/// Two levels of which every row may have either, at random: levels far apart with next to nothing
/// between them, which the speed, the load, the temperature, the angle and the direction do not
/// foretell. `changes` is empty where there are none such.
[[nodiscard]] LikeliestStates scattered_states(const DriveContext& context,
                                               const Eigen::VectorXd& left);

/// When which of two levels was there, of what `left` holds of one kind; `changes` where they were
/// thought to be.
[[nodiscard]] std::vector<double> changes_of_states(const DriveContext& context,
                                                    const Eigen::VectorXd& left, double what,
                                                    FitRows rows,
                                                    const std::vector<double>& changes);

/// Levels between which a run jumps: each new, and as long as it lasts.
struct LevelsOfRun {
  std::vector<double> changes;  ///< 0 ... 1 of the run, between rows
  std::vector<double> levels;   ///< after each of them [N m at the input]; before the first 0
};
/// The likeliest of what `left` holds of one kind; `changes` is empty where there are none such.
/// The scatter of rows that follow each other is taken for noise.
[[nodiscard]] LevelsOfRun likeliest_levels(const DriveContext& context, const Eigen::VectorXd& left,
                                           double what);
/// As many changes as these, moved to where these rows say, and their levels.
[[nodiscard]] LevelsOfRun levels_beside(const DriveContext& context, const Eigen::VectorXd& left,
                                        double what, FitRows rows, std::vector<double> changes);
/// The levels between changes that stay where they are.
[[nodiscard]] LevelsOfRun levels_as_cut(const DriveContext& context, const Eigen::VectorXd& left,
                                        double what, FitRows rows,
                                        const std::vector<double>& changes);

}  // namespace trueflank::loop
