// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/carrier.h"

// Bodies of an assembly as stacks of discs, for comparing them without their facets.
namespace trueflank {

struct Disc {
  Point2 centre = Point2::Zero();
  double radius_mm = 0.0;
};

/// One slab of a body where it stands, all outlines as circles on the safe side: outer ones
/// circumscribed, holes inscribed.
struct BodyLayer {
  HeightRange z;
  Disc outer;
  std::vector<Disc> holes;
  /// Its teeth, outside or in its first hole; nullptr: none.
  const ToothedOutline* teeth = nullptr;
};

/// The slabs of a part at its place; refers to the part.
[[nodiscard]] std::vector<BodyLayer> body_layers(const PartShape& part, const Placement& placement);

/// How far two layers that stand still against each other are apart, across the axis; negative: how
/// deep one is in the other.
[[nodiscard]] double gap_at_rest_mm(const BodyLayer& a, const BodyLayer& b);

}  // namespace trueflank
