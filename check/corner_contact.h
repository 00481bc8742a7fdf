// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/check/finding.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// `corner_contact`, one finding a mesh: how deep a tip corner or a fillet stands in the mate where the play is
/// taken up and the flanks just touch, as one gear drives the other; the worse of both directions [um]. There
/// the corner touches first and carries. Warns above 0 (tolerance::kTouch_mm), fails above the design's
/// corner_contact_limit_mm or corner_contact_limit_mm(): see docs/checks.md.
[[nodiscard]] Findings check_corner_contact(const GearTrain& train, const std::vector<MeshState>& states);

/// What the teeth's own bending at full load takes up, of a module: 0.005 of it.
[[nodiscard]] double corner_contact_limit_mm(double normal_module_mm);

}  // namespace trueflank
