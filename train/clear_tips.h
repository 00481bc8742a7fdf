// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Length of the line of action, of the module, by which a clear tip ends short of its mate's root form circle:
/// what a centre distance smaller by 0.01 module takes of it. It costs 0.01 of contact ratio.
inline constexpr double kTipMargin = 0.03;

/// Shortens every tip that would make contact with a mate's root fillet (or beyond its base circle) until the
/// contact ends kTipMargin short of it; what is shortened had no flank to touch. Tips whose diameter is given are
/// kept, and those where less than half of the flank or a contact ratio below 1.15 in the gear's other mesh would be
/// left: there only other gears help.
/// Returns by how much each tip circle's radius was shortened [mm].
[[nodiscard]] std::vector<double> clear_tips(const GearboxDesign& design, const std::vector<TrainMesh>& meshes,
                                             double centre_distance_mm, std::vector<Gear>& gears);

}  // namespace trueflank
