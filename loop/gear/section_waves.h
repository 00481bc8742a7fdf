// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Sections that stand aside in waves over the height: what they do in the plane is an ellipse.
struct SectionWave {
  double wavelength_mm = 0.0;
  double towards_deg = 0.0;                ///< of its long axis
  double along_um = 0.0, across_um = 0.0;  ///< half axes; across < 0: clockwise with the height
  double square = 0.0;                     ///< squares that it takes out, about
};

/// The likeliest lengths in residuals of helix traces and scanned flanks (`row_um`: of every row of
/// the table), beside a section that stands aside and leans; the best first, a few. Zeros of traces
/// are taken to be alike: the length and the direction are to start from.
[[nodiscard]] std::vector<SectionWave> likeliest_section_waves(const FlankGeometry& geometry,
                                                               const Observations& table,
                                                               const Patches& patches,
                                                               const std::vector<float>& row_um);

}  // namespace trueflank::loop
