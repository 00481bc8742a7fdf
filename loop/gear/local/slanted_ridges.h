// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

// Ridges and grooves in straight lines aslant over scanned flanks, or around the gear as they rise.
namespace trueflank::loop {

struct SlantedRidge {
  Effect form;           ///< unnamed_slanted_ridge
  double p_value = 1.0;  ///< corrected for all lines and widths
  double square = 0.0;   ///< squares that it takes out of all rows
  double amount_um = 0.0;
};

/// The likeliest one, of both flanks or one. None where a ridge that is not aslant says nearly as
/// much, or most of what hangs together on the flanks is something else. `row_um`: residuals of the
/// table's rows; `scanned`: which rows are looked at (scanned_flank_rows).
[[nodiscard]] std::optional<SlantedRidge> likeliest_slanted_ridge(
    const FlankGeometry& geometry, const Observations& table, const std::vector<float>& row_um,
    const std::vector<std::uint32_t>& scanned);

}  // namespace trueflank::loop
