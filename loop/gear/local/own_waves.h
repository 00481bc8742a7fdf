// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/local/flank_waves.h"
#include "trueflank/loop/gear/local/wave_products.h"

namespace trueflank::loop::flank_waves {

/// Halves of a wave that are asked about at most, over the profile and over the face.
struct WavesAsked {
  int most_profile = kProfile, most_face = kFace;
};

/// As OwnWaves says, the largest of either side that chance hardly makes; `flanks`: of every tooth
/// first the clockwise one, with the sums of `values`.
[[nodiscard]] std::vector<OwnWaves> own_waves(const std::vector<FlankSums>& flanks,
                                              const std::vector<Value>& values,
                                              const WavesAsked& asked);

/// One of these in words; `both`: the two flanks have the same, but for the direction.
[[nodiscard]] std::string words_of(const FlankGeometry& geometry,
                                   const std::vector<OwnWaves>& waves, const OwnWaves& wave,
                                   bool both);

}  // namespace trueflank::loop::flank_waves
