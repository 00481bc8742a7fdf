// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Forms of one family on one choice of flanks, and what the first takes out, in squares.
struct LikelyForms {
  double gain = 0.0;
  std::vector<Effect> forms;
};

/// Products of courses that values look like most, to start from.
struct LikeliestProducts {
  std::vector<LikelyForms> same_on_every_tooth;    ///< unnamed_crossed
  std::vector<LikelyForms> beside_names;           ///< the same, beside levels, slopes and bows
  std::vector<LikelyForms> around_the_gear;        ///< unnamed_crossed_around
  std::vector<LikelyForms> waves;                  ///< unnamed_crossed_waves
  double square = 0.0, square_beside_names = 0.0;  ///< of the residuals
};

/// From residuals of scanned flanks and of traces (`row_um`: of every row of the table), as sums in
/// cells of the flanks: what other effects beside a form take out is not asked.
[[nodiscard]] LikeliestProducts likeliest_products(const FlankGeometry& geometry,
                                                   const Observations& table,
                                                   const Patches& patches,
                                                   const std::vector<float>& row_um);

}  // namespace trueflank::loop
