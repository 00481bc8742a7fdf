// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>

#include "trueflank/base/result.h"
#include "trueflank/solid/part_shape.h"
#include "trueflank/train/process.h"

namespace trueflank {

/// Parts as they must be written so that a process makes what was designed.
struct CompensatedShapes {
  PartShapes shapes;                  ///< assembly and names as they were
  std::deque<ToothProfile> profiles;  ///< of the shapes' outlines; they move along with it
};

/// Every wall moved into the material by the process's horizontal expansion (outwards where that is
/// negative), and the lowest layers by the elephant foot besides: over its height by a share that
/// falls linearly to nothing, in steps of the layer height, each step right at its middle.
/// Teeth stay exact: the offset of a gear is the gear of a tool that is wider, deeper and rounder by
/// the offset. Bores, rims and holes are offset exactly but for the corners of keyways, flats and
/// hexagons, which stay sharp.
/// Heights do not change: the offset is that of the sections. Helical teeth get no elephant foot: each step would need its own turn.
/// Requires: `shapes` and the profiles it refers to outlive the result.
/// Errors: kInfeasible where no gear or bore of the moved walls exists; kUnsupported for helical or
/// modified teeth with an elephant foot.
/// Accuracy: 1e-8 mm for straight teeth cut by racks and for ring fillets, tested by OutlineDistance
/// in tests/solid/process_compensation_test.cpp; a shaped ring's root fillet within a tenth of the
/// offset, as is the root of helical teeth.
[[nodiscard]] Result<CompensatedShapes> compensated(const PartShapes& shapes,
                                                    const Process& process);

/// The gear whose section's walls lie this far inside the material of another's.
[[nodiscard]] Gear offset_gear(Gear gear, double inwards_mm);

}  // namespace trueflank
