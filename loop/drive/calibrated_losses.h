// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gear_train.h"

namespace trueflank::loop {

/// A design's friction and [losses] while effects found on a bench are put into them.
struct CalibratedLosses {
  LossesDesign losses;
  double friction_shift = 0.0;       ///< of both directions
  double friction_difference = 0.0;  ///< backward less forward
  double bench_temperature_c = 0.0;  ///< mean of the bench's rows, at which its effects hold
  double bench_load_nm = 0.0;        ///< largest torque at the input

  /// What an amount at the bench's temperature is at the losses' own, for an effect that thins by `rate`
  /// per degree.
  [[nodiscard]] double at_reference(double amount, double rate_per_c) const;
  /// One amount with one shape: false where one of another shape stands there already.
  [[nodiscard]] static bool add(double& amount, double more, double& shape, double its_shape);
};

}  // namespace trueflank::loop
