// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "trueflank/loop/drive/drive_effect.h"

// Parts of a run, or of every turn of a shaft, in which a bench differs from the rest.
namespace trueflank::loop {

/// The part of the training rows that differs most from the rest, as a loss, a friction or a zero
/// of the output's torque.
struct LikeliestSpell {
  double p_value = 1.0;              ///< of so large a difference in any part of noise
  double what = 0.0;                 ///< drive_effects::What
  double order = 0.0;                ///< of the turn, per turn of the input; 0: the run
  double begin = 0.0, length = 0.0;  ///< 0 ... 1; the part of a turn may go on beyond 1
};
/// Over the run where `order` is 0. The turns asked for are those of input, output and the train's
/// other shafts.
[[nodiscard]] LikeliestSpell likeliest_spell_of_run(const DriveContext& context,
                                                    const Eigen::VectorXd& left);
[[nodiscard]] LikeliestSpell likeliest_spell_of_turns(const DriveContext& context,
                                                      const Eigen::VectorXd& left);

}  // namespace trueflank::loop
