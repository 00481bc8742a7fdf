// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Values of scanned flanks at places of the transverse plane, without their mean.
struct PlaneValues {
  std::vector<double> um;
  double mean_um = 0.0;  ///< which was taken off
  std::array<std::vector<double>, 2> at_mm;
  std::array<std::vector<double>, 2> normal;  ///< what a shift along x and along y is worth
  std::vector<int> flank;                     ///< of which the value is, numbered from 0
  std::size_t rows = 0;                       ///< of which these are some
};

/// Of a scan's many values so many as tell what is asked. `row_um`: residuals of the table's rows;
/// `rows`: which are looked at (scanned_flank_rows).
[[nodiscard]] PlaneValues values_in_plane(const FlankGeometry& geometry, const Observations& table,
                                          const std::vector<float>& row_um,
                                          const std::vector<std::uint32_t>& rows);

}  // namespace trueflank::loop
