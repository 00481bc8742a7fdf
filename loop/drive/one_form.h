// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"

namespace trueflank::loop {

/// A set in place of the outcome's, with what it leaves.
struct DriveSelection::OneForm {
  std::vector<DriveEffect> effects;
  std::vector<int> from;  ///< of each, its place in the outcome; -1: new
  double square = std::numeric_limits<double>::max();
  int size = 0;
  /// The least is told.
  [[nodiscard]] double figure(double noise) const {
    constexpr double kEachFigure = 6.6, kOddShape = 4.0;  // chi-square
    double odd = 0.0;
    for (const DriveEffect& e : effects)
      odd += (e.family->named ? 0.0 : 1.0) +
             (e.family->is_odd && e.family->is_odd(e.shape) ? 1.0 : 0.0);
    return square / noise + kEachFigure * size + kOddShape * odd;
  }
};

}  // namespace trueflank::loop
