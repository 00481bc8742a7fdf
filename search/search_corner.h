// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/geometry/gear_pair.h"

namespace trueflank {

/// How far the mate's tip corner stays from the root of a gear while it passes through the gap, at
/// zero backlash: smallest distance along the circle [mm], over the root fillet and, where the mate's
/// tip reaches beyond the base circle's tangent point, over the flank above it. Negative: it cuts in.
/// Exact geometry, unlike the comparison of start of active profile and root form circle: an undercut
/// root often clears a tip that runs below its root form circle.
/// Accuracy: 1e-6 module, tested against turning the gears.
/// @{
[[nodiscard]] double corner_clearance_in_gear1_mm(const GearPair& pair);  ///< tip 2 in root 1
[[nodiscard]] double corner_clearance_in_gear2_mm(const GearPair& pair);  ///< tip 1 in root 2
/// @}

/// A clearance that was asked for only as far as it matters.
struct CornerLook {
  double clearance_mm = kNaN;
  bool least = true;  ///< the least clearance; else that of some place, which is below what was enough
};
/// Enough is no clearance: what is found is the least one.
inline constexpr double kLeastOfAll_mm = -1e300;
/// Ends at the first place found whose clearance is below `enough_mm`. `first` is the sample of the
/// fillet to look at first, and becomes the nearest one: neighbours in a search are close at the same.
/// @{
[[nodiscard]] CornerLook look_for_corner_in_gear1(const GearPair& pair, double enough_mm, int& first);
[[nodiscard]] CornerLook look_for_corner_in_gear2(const GearPair& pair, double enough_mm, int& first);
/// @}

/// What a look needs that ends at the sample it begins with: no profile of the mate.
struct CornerSample {
  const ToothProfile* root = nullptr;  ///< of the visited gear; not owned
  const Gear* mate = nullptr;          ///< not owned
  double centre_distance_mm = kNaN;
};
/// The clearance at a sample of the root; nothing where the mate's tip is not that of its tip circle, or
/// the root has no fillet.
[[nodiscard]] std::optional<double> corner_clearance_at_sample_mm(const CornerSample& of, int sample);

}  // namespace trueflank
