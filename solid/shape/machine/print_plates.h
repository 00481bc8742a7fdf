// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/machine/bed.h"

namespace trueflank {

/// A part on a bed: its axis stands at a point from the bed's corner.
struct PrintedPart {
  int part = 0;  ///< index into PartShapes::parts
  Point2 at_mm = Point2::Zero();
};
using PrintPlate = std::vector<PrintedPart>;

/// Every part that is made, as often as the assembly has it, in rows on as few beds as rows give,
/// largest first, a gap between any two. A part takes the square around its outline. Errors:
/// kInfeasible where a part is larger than the bed.
[[nodiscard]] Result<std::vector<PrintPlate>> print_plates(const PartShapes& shapes, const Bed& bed,
                                                           double gap_mm = 5.0);

}  // namespace trueflank
