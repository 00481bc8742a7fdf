// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// What scanned flanks have alike at every height: random error differs from height to height.
struct AlikeOverHeight {
  double pattern_um = 0.0;  ///< rms of what is alike
  double noise_um = 0.0;    ///< rms of the error beside it
  double p_value = 1.0;
};

/// Points of one flank that lie at one place of the section and far apart in height differ by their
/// error alone, whatever the section looks like. Compared with what is left of every flank beside a
/// curved surface of its own. Nothing where the flanks have not enough such points, or where both
/// are alike. `row_um`: residuals of the table's rows; `used`: which rows are looked at.
[[nodiscard]] std::optional<AlikeOverHeight> alike_over_height(const FlankGeometry& geometry,
                                                               const Observations& table,
                                                               const std::vector<float>& row_um,
                                                               const std::vector<bool>& used);

}  // namespace trueflank::loop
