// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// What neighbouring teeth share of a residual: a dent, a swelling or a warp over a few teeth, which as
/// sums of waves is too many small terms to be found by them.
struct SharedByNeighbours {
  double p_value = 1.0;  ///< of so much agreement among teeth in any order
  int tooth = 0;         ///< about which it is largest
  double height_mm = 0.0, amount_um = 0.0;
};

/// The product of neighbouring teeth's residuals, place by place and flank by flank, against the same teeth
/// in shuffled order, each flank's apart: nothing is assumed of how errors hang together within a flank.
/// `row_um`: the residual of every row of the table behind the patches.
/// Limits: errors of whole teeth that both flanks share make the level of 0.002 about 0.02.
[[nodiscard]] SharedByNeighbours shared_by_neighbours(const FlankGeometry& geometry,
                                                      const Patches& patches,
                                                      const std::vector<float>& row_um);

/// "about tooth 8, at a height of 4.2 mm, 20.1 um are missing ..."
[[nodiscard]] std::string words_for(const SharedByNeighbours& shared);

}  // namespace trueflank::loop
