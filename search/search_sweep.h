// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/search/search_values.h"

// The best efficiency of a tooth set, by sweeping the centre distance. At a fixed centre distance
// the layers do not know of each other: each is a problem of one shift, solved on all its feasible
// intervals with their ends. What is left is a function of the centre distance alone.
namespace trueflank {

/// A point of the sweep.
struct SweepPoint {
  FreeShifts free;
  double merit = -1.0;   ///< the efficiency; meaningless where a limit is broken
  double margin = -1e9;  ///< least distance to a limit [modules]; below 0: broken
  [[nodiscard]] bool feasible() const { return margin >= 0.0; }
};

struct SweepResult {
  std::vector<SweepPoint> peaks;  ///< feasible, best first; the best is solved to the end
  SweepPoint nearest;             ///< without a feasible point: where the breach is least
  /// How much the best rose in the last steps, and when centre distances around it were looked at again with a
  /// finer grid of shifts at other places: what the sweep may still lack, as far as it can tell. Measured, no bound.
  double gap = kNaN;
};

/// Requires: a direction whose efficiency counts.
/// Accuracy: 1e-6 of the best efficiency, tested against dense grids with refinement.
[[nodiscard]] SweepResult sweep(SetValues& values, DriveDirection direction);

}  // namespace trueflank
