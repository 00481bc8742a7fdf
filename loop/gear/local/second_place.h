// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Points of scanned flanks that stand aside from the others by one displacement in the plane, at
/// random among them.
struct SecondPlace {
  double share = 0.0;                 ///< of the points
  std::array<double, 2> these_um{};   ///< where they stand, along x and y
  std::array<double, 2> others_um{};  ///< where the others do
  std::vector<std::size_t> rows;      ///< of the table
  double p_value = 1.0;               ///< against noise that goes with the wall's direction
};

/// From what effects leave (`row_um`: of every row of the table). None where noise says as much: it
/// may be larger on walls that face one direction, and its tails may be long. None where the points
/// lie together: a part of the gear that moved is another thing.
[[nodiscard]] std::optional<SecondPlace> second_place(const FlankGeometry& geometry,
                                                      const Observations& table,
                                                      const Patches& patches,
                                                      const std::vector<float>& row_um);

}  // namespace trueflank::loop
