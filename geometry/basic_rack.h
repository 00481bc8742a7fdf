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
  /// How far the tool's tip corner stands out of the tool's own flank, along the flank's normal;
  /// 0: a tool without protuberance. Tools that cut external gears only.
  double protuberance = 0.0;
  double protuberance_angle_rad = 0.17453292519943295;  ///< pressure angle of its side, 10 degrees
  double grinding_stock = 0.0;  ///< what the tool leaves on either flank for grinding, normal to it

  bool operator==(const BasicRack&) const = default;
};

/// Undercut that is left below the finished flank, normal to it: protuberance less stock; 0 without
/// a protuberance. Coefficient of the module.
[[nodiscard]] double residual_protuberance(const BasicRack& rack);

/// Largest tip rounding the cutting rack can carry: the arc that touches both flanks and the tip
/// line (full round). Negative where the rack tooth is pointed before its depth.
[[nodiscard]] double full_round_coefficient(const BasicRack& rack);

}  // namespace trueflank
