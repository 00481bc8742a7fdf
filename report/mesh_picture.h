// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/check/mesh_clearance.h"
#include "trueflank/geometry/gear_pair.h"

namespace trueflank {

struct MeshPictureOptions {
  std::string name1 = "gear 1", name2 = "gear 2";
  double width_px = 900.0;
  double turn_rad = 0.0;  ///< of gear 1 out of the place shown, for a sequence of frames
};

/// SVG of a pair at a place: the teeth around the mesh, tip, working pitch and base circles, the line of
/// action with the part that is in contact, the active profiles, and the place itself; an inset
/// shows it magnified, with clearance or penetration to scale. Same input, same bytes.
/// Frame: that of MeshPlace, y up. Accuracy: chords within 0.002 module, in the inset within a quarter of a thousandth of its width.
[[nodiscard]] std::string mesh_picture_svg(const GearPair& pair, const MeshClearance& clearance,
                                           const MeshPictureOptions& options = {});

}  // namespace trueflank
