// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// A hollow or swelling over a few neighbouring teeth.
struct Dent {
  int side = 0;                           ///< +1, -1: on these flanks only; 0: on both
  double tooth = 0.0, half_teeth = 0.0;   ///< exp(-((tooth - this) / half)^2)
  double height_mm = 0.0, half_mm = 0.0;  ///< the same over the face; half 0: over all of it
  double square = 0.0;                    ///< weighted squares it takes out
  double amount_um = 0.0;
};

/// The dent that takes most out of the residuals of scans; empty where there are none.
/// `row_um`: residuals of the table's rows; `used`: which rows are looked at.
[[nodiscard]] std::optional<Dent> largest_dent(const FlankGeometry& geometry,
                                               const Observations& table,
                                               const std::vector<float>& row_um,
                                               const std::vector<bool>& used);

}  // namespace trueflank::loop
