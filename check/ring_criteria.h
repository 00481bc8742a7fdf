// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/gear_pair.h"

// The textbook criteria of internal pairs, written with the real tooth thicknesses so that thinning,
// implied backlash and modified tips count. At zero backlash they are KHK's (docs/interference.md derives
// them). A tip corner is where flank and tip circle meet; of a rounded tip, every point of the rounding.
// Where the halves of a section's teeth differ, the worse of both sides.
// Requires of all: pair.internal().
namespace trueflank {

/// Margin of the trochoid criterion, angle of the ring [rad]: where the tip circles cross, how far
/// the ring's tip corner lags behind the pinion's. Infinite where the tip circles do not cross because
/// the pinion does not reach the ring's teeth, NaN where the pinion's tip circle lies around it.
[[nodiscard]] double trochoid_margin_rad(const GearPair& pair);

/// Margin of the trimming criterion, angle of the ring [rad]: how far the pinion's tip corner passes
/// the ring's when moved towards the ring's axis. NaN where the pinion's tip circle is not smaller than
/// the ring's.
[[nodiscard]] double trimming_margin_rad(const GearPair& pair);

/// Where the pinion of an internal pair can leave the ring along the line of centres, found by moving
/// the real profiles.
struct RadialRemoval {
  double free_share = 0.0;  ///< share of all rotations at which it can
  bool at_every_rotation = false;
  bool at_some_rotation = false;
  /// One by one, evenly over a pitch of the pinion, tooth 1 on the line of centres first; empty where
  /// the pinion's tip circle is too large.
  std::vector<bool> free_at = {};
};
/// Accuracy: 64 rotations a pitch; less overhang than 1 um at module 1 is not seen.
[[nodiscard]] RadialRemoval radial_removal(const GearPair& pair);

/// Of a gear with several sections along its face, which all leave together; `twist_rad`: by how much
/// the pinion's sections turn over the face. A section is taken to stand anywhere in that range.
[[nodiscard]] RadialRemoval radial_removal(const std::vector<GearPair>& sections, double twist_rad);

}  // namespace trueflank
