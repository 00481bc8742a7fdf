// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// What drifts evenly once around, by the direction in which a point lies, and jumps back: of both
/// flanks alike.
struct Spiral {
  double from_deg = 0.0;  ///< where it jumps; it drifts counter-clockwise from there
  double p_value = 1.0;
  bool outwards = false;  ///< a radius drifts; else all walls along their normals
};

/// From the residuals of scanned flanks: where a drift follows better than more waves do what waves
/// of one to three a turn leave, and hardly anything is left around the gear beside it.
[[nodiscard]] std::optional<Spiral> spiral_around(const FlankGeometry& geometry,
                                                  const Observations& table, const Patches& patches,
                                                  const std::vector<float>& row_um);

}  // namespace trueflank::loop
