// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Sections that stand aside in waves over the height: what they do in the plane is an ellipse.
struct SectionWave {
  double wavelength_mm = 0.0;
  double towards_deg = 0.0;                ///< of its long axis
  double along_um = 0.0, across_um = 0.0;  ///< half axes; across < 0: clockwise with the height
  double square = 0.0;                     ///< squares that it takes out, about
};

/// What sections that stand aside look like most, to start from.
struct SectionsAside {
  std::vector<SectionWave> waves;              ///< the best first, a few
  std::array<double, 2> steps_mm{kNaN, kNaN};  ///< heights of two steps
};

/// From residuals of helix traces and scanned flanks (`row_um`: of every row of the table); waves
/// beside a section that stands aside and leans. Zeros of traces are taken to be alike.
[[nodiscard]] SectionsAside sections_aside(const FlankGeometry& geometry, const Observations& table,
                                           const Patches& patches,
                                           const std::vector<float>& row_um);

}  // namespace trueflank::loop
