// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// Chamfers all outlines of a part's lowest face, z = 0: teeth with their roots, rims, bores and holes.
/// The walls there lie `depth` inside the material, less and less up to `height`; corners of keyways,
/// flats and hexagons stay sharp, all else is the exact parallel curve.
/// Less deep where teeth or walls would not stand it: of every wall half is left, of every piece of a
/// tooth's profile a tenth (InsetProfile). Teeth that have an edge chamfer keep that alone.
/// Requires: depth and height above 0. `profiles` and what the part refers to outlive the part.
/// Returns a sentence where the chamfer is not as asked.
[[nodiscard]] std::optional<std::string> add_bed_chamfer(PartShape& part, double depth_mm,
                                                         double height_mm,
                                                         std::deque<InsetProfile>& profiles);

/// The largest bed chamfer of a part's outlines; 0: none.
[[nodiscard]] double bed_depth_mm(const PartShape& part);

}  // namespace trueflank
