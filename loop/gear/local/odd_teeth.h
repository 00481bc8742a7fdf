// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/remainder_around.h"

// Single teeth whose flanks have a form that the others do not have.
namespace trueflank::loop {

/// Level of what stands on one tooth, of all that was asked about together. Other forms are seen on
/// many teeth; one of a single tooth has nothing else to bear it out.
inline constexpr double kLevelOfTooth = 5e-4;
[[nodiscard]] inline double level_of(const RemainderFinding& finding) {
  return finding.local ? kLevelOfTooth : kRemainderLevel;
}

/// Flanks of one tooth that lean or bend, over the profile or over the face, by far more than those
/// of the others do, one flank by itself or both, alike or opposite; where that is most of what
/// stands on them. Then flanks that deviate in any form by themselves, in words. At most a few,
/// the surest first; those at `kLevelOfTooth` or below. How far the teeth differ says what is
/// usual: gears whose teeth all differ have none. Requires: eight teeth of a kind of record.
[[nodiscard]] std::vector<RemainderFinding> odd_teeth(const FlankGeometry& geometry,
                                                      const MomentsOfTeeth& moments);

/// Of a form of a tooth and spots on the same flanks, which are two ways to tell the same, only
/// what takes out more remains: the others are taken from `found`, or left out of what is returned.
[[nodiscard]] std::vector<RemainderFinding> without_spots_alike(
    std::vector<RemainderFinding> odd, std::vector<RemainderFinding>& found);

}  // namespace trueflank::loop
