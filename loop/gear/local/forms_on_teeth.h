// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Something along the flanks that some neighbouring teeth have and the others have not.
struct FormOnTeeth {
  FlankChoice flank = FlankChoice::kBoth;
  bool opposite = false;      ///< on the two flanks
  int first = 0, count = 0;   ///< the teeth
  double p_value = 1.0;       ///< were the course of every flank its own, corrected for all runs
  std::vector<Effect> forms;  ///< what its course looks like, on these teeth: to start from
};

/// From residuals (`row_um`: of every row of the table), along the profile (0) or the face (1).
/// What each flank has of a slope and a bow is taken out first. Every run of teeth is asked how
/// much of the squares its mean course takes out; the best is compared with what it leaves on every
/// flank, and with what comes once to three times per turn. Nothing where most of what the teeth
/// have along their flanks is no course of the run.
[[nodiscard]] std::optional<FormOnTeeth> form_on_teeth(const FlankGeometry& geometry,
                                                       const Observations& table,
                                                       const Patches& patches,
                                                       const std::vector<double>& row_um, int face);

}  // namespace trueflank::loop
