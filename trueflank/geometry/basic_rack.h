// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank {

/// Basic rack in the normal section; lengths are coefficients of the normal module.
/// Default: ISO 53 profile A.
struct BasicRack {
  double pressure_angle_rad = 0.3490658503988659;  // 20 degrees
  double addendum = 1.0;
  double dedendum = 1.25;
  double root_radius = 0.38;  ///< 0: sharp corner

  bool operator==(const BasicRack&) const = default;
};

/// Largest tip rounding the cutting rack can carry: the arc that touches both flanks and the tip
/// line (full round). Negative where the rack tooth is pointed before its depth.
[[nodiscard]] double full_round_coefficient(const BasicRack& rack);

}  // namespace trueflank
