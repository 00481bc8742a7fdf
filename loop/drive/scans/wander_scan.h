// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "trueflank/loop/drive/drive_effect.h"

// Slow courses of a run: zeros that wander, warmth that comes and goes.
namespace trueflank::loop {

/// The slow course that the training rows follow most, as a loss, a friction or a zero of the
/// output's torque.
struct LikeliestWander {
  double p_value =
      1.0;  ///< of so much in the slowest half waves, where noise has as much in faster ones
  double what = 0.0;  ///< drive_effects::What
  int degree = 0;     ///< of the polynomial that holds it: 5 in a short run, else 7
};
/// `left`: what is left of every row [N m]. Errors that hang together over few rows fill slow and
/// faster waves alike: they are no slow course.
[[nodiscard]] LikeliestWander likeliest_wander(const DriveContext& context,
                                               const Eigen::VectorXd& left);

}  // namespace trueflank::loop
