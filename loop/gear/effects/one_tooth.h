// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/effect.h"

// What one tooth, one gap or a few neighbouring teeth have as a whole.
namespace trueflank::loop::gear_effects {

/// One tooth from an end of its profile or face on: bent, thicker, or swollen between both ends.
[[nodiscard]] EffectFamily unnamed_bent_tooth();
/// All of a tooth, the simplest first; of a single flank those that are not opposite.
[[nodiscard]] std::vector<EffectShape> shapes_of_bent_tooth(int tooth, bool both_flanks);
/// A pitch error of one tooth: more material on one flank, as much less on the other.
[[nodiscard]] EffectFamily unnamed_tooth_aside();
/// The two walls of the gap after a tooth, counter-clockwise: out alike, or the gap aside.
[[nodiscard]] EffectFamily unnamed_gap();
/// A swelling or hollow of one side's flanks that dies away over the neighbouring teeth, the
/// profile and the face: a burnt patch.
[[nodiscard]] EffectFamily unnamed_swelling_over_teeth();
/// Such ones about a tooth, a diameter and a height [mm], to start from.
[[nodiscard]] std::vector<EffectShape> patches_about(const FlankGeometry& geometry, double tooth,
                                                     double diameter_mm, double height_mm);

}  // namespace trueflank::loop::gear_effects
