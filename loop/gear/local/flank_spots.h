// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// A place of one flank of a scan that stands out: a burr, a spot, a dent.
struct FlankSpot {
  double p_value = 1.0;  ///< corrected for all windows of all flanks
  int tooth = 0, side = 1;
  double roll_mm = 0.0, height_mm = 0.0;
  double half_profile_mm = 0.0, half_face_mm = 0.0;  ///< 0: over all of it
  double amount_um = 0.0;                            ///< mean over the window
  double square = 0.0;                               ///< that it takes out of the window's values
};

/// The most certain spot of every flank with p below 1, at most a few. Windows of several sizes
/// over every flank; how far their means scatter over all flanks of that side says what is usual, so
/// that errors that hang together, or a side that is noisier, are no finding; wild points count no more than 3.5 spreads. `row_um`:
/// residuals of the table's rows.
[[nodiscard]] std::vector<FlankSpot> spots_of_scans(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const Patches& patches,
                                                    const std::vector<float>& row_um);

}  // namespace trueflank::loop
