// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/loop/gear/close_loop.h"

namespace trueflank::loop {

/// Residuals of one flank of one tooth, as classical evaluation sees them; NaN where nothing was
/// measured.
struct FlankResiduals {
  static constexpr int kParts = 24;
  std::array<double, kParts> profile{};  ///< mean over the height, by roll length from root to tip
  std::array<double, kParts> helix{};    ///< mean over the roll length, from bottom to top
  double index = kNaN;                   ///< the flank's place: mean, or the index record's value
};

struct ResidualGrid {
  /// [tooth - 1][0 clockwise side, 1 counter-clockwise side]
  std::vector<std::array<FlankResiduals, 2>> teeth;
  /// Mean over all teeth: [side][profile part][face part]
  std::array<std::array<std::array<double, FlankResiduals::kParts>, FlankResiduals::kParts>, 2>
      topography{};
};

/// Gathers the residuals before the effects.
[[nodiscard]] ResidualGrid residual_grid_before(const GearLoop& closed);
/// Those before and those after the effects.
[[nodiscard]] std::array<ResidualGrid, 2> residual_grids(const GearLoop& closed);

}  // namespace trueflank::loop
