// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/process.h"

namespace trueflank {

/// Parts as they must be written so that a process makes what was designed.
struct CompensatedShapes {
  PartShapes shapes;  ///< assembly and names as they were; they keep their profiles
  /// From the profiles of the shapes it was made of to those of these.
  std::map<const ToothProfile*, const ToothProfile*> moved = {};
  std::vector<std::string> notes;     ///< where a bed chamfer is not as the process wants it
};

/// Every wall moved into the material by the process's horizontal expansion (outwards where that is
/// negative), in the plane of the sections; heights do not change. Then the lowest face of every part,
/// which lies on the bed, gets a chamfer as deep and high as the process's elephant foot (45 degrees
/// where it gives no height; add_bed_chamfer()).
/// Teeth stay exact: the offset of a gear is the gear of a tool that is wider, deeper and rounder by
/// the offset. Bores, rims and holes are offset exactly but for the corners of keyways, flats and
/// hexagons, which stay sharp.
/// Requires: what `shapes` refers to and does not keep outlives the result.
/// Errors: kInfeasible, key made.process, where no gear or hole of the moved walls exists.
/// Accuracy: 1e-8 mm for straight teeth cut by racks and for ring fillets, tested by OutlineDistance
/// in tests/solid/process_compensation_test.cpp; a shaped ring's root fillet within a tenth of the
/// offset, as is the root of helical teeth.
[[nodiscard]] Result<CompensatedShapes> compensated(const PartShapes& shapes,
                                                    const Process& process);

/// The gear whose section's walls lie this far inside the material of another's.
[[nodiscard]] Gear offset_gear(Gear gear, double inwards_mm);

}  // namespace trueflank
