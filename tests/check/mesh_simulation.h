// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/toothing.h"

// An independent judge of the overlap check: brute force, sharing nothing with it but the curves.
namespace trueflank::test {

/// Smallest signed distance of two outlines over one pitch of rotation.
struct SimulatedClearance {
  double clearance_mm = 0.0;  ///< at most the window below; negative: penetration
  double window_mm = 0.0;     ///< distances beyond this are not looked for
};

/// All teeth near the mesh as dense polygons, placed at many rotations over one pitch with the backlash
/// centred; every vertex of either gear against the edges of the other. Which side a vertex lies on is
/// decided by counting the edges that a circle about the axis crosses on the way from a tooth's middle.
/// Accuracy: overestimates the clearance by at most about 0.4 um at module 1 (vertices every 0.02 module
/// or 0.1 um of sag, positions every 0.01 module of relative travel). Gear 2 is turned by an angle out of the
/// centred position.
[[nodiscard]] SimulatedClearance simulate_mesh(const GearPair& pair, double gear2_turn_rad = 0.0);

/// One gear of a modified mesh at a height, as its surface points say (section_point).
struct MadeSection {
  Toothing toothing;
  double z_mm = 0.0;
};
/// The same of two such sections, gear 2 turned by an angle out of the centred position.
[[nodiscard]] SimulatedClearance simulate_sections(const MadeSection& gear1, const MadeSection& gear2,
                                                   double centre_distance_mm,
                                                   double gear2_turn_rad = 0.0);
/// At one position.
[[nodiscard]] double simulate_position_mm(const MadeSection& gear1, double rotation1_rad,
                                          const MadeSection& gear2, double rotation2_rad,
                                          const Point2& axis2_mm);

/// Both gears at one position, gear 1 at the origin, gear 2 at `axis2_mm`.
[[nodiscard]] double simulate_position_mm(const GearPair& pair, double rotation1_rad,
                                          double rotation2_rad, const Point2& axis2_mm);

}  // namespace trueflank::test
