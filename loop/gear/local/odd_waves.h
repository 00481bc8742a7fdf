// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Waves along the flanks, the same on every tooth.
struct OddWave {
  Effect form;  ///< unnamed_waves_changing, unnamed_waves_dying
  double p_value = 1.0;
};

/// What traces along the profile, and along the face, have as waves that change their length or die
/// away from an end, and that nothing simpler follows nearly as well: no wave of one length, no
/// bow, step, groove, kink or rise at an end. At most one of either flank in either direction, of
/// one shape where the flanks' are alike; of values that are not held out. `row_um`: what is left
/// in every row of the table.
[[nodiscard]] std::vector<OddWave> odd_waves(const FlankGeometry& geometry,
                                             const Observations& table, const Patches& patches,
                                             const std::vector<float>& row_um);

}  // namespace trueflank::loop
