// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/geometry/gear_pair.h"

namespace trueflank {

/// Whether the outlines of two gears cross at one position, by exact predicates.
struct ToothCrossing {
  bool cross = false;
  double chord_error_mm = 0.0;  ///< largest distance of the two polygons from their curves, added up
};

/// The teeth around the mesh as polygons with vertices on the curves; no rounding decides: whether
/// two segments meet is answered exactly for their coordinates.
/// Frame: see MeshPlace. `centre2_mm`: axis of gear 2. `tolerance_mm`: how far either polygon may be from
/// its curves.
[[nodiscard]] ToothCrossing teeth_cross(const GearPair& pair, double rotation1_rad,
                                        double rotation2_rad, const Point2& centre2_mm,
                                        double tolerance_mm);

}  // namespace trueflank
