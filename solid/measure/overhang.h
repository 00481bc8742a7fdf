// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/shape/part_shape.h"

// What of a part hangs free while it is printed, layer upon layer.
namespace trueflank {

/// Parts are prisms one upon the other: what hangs is flat undersides, and twisted flanks. Outlines
/// are taken as circles: teeth reach to their tips, what is under them to their roots.
struct Overhang {
  double ledge_mm = 0.0;         ///< how far an underside stands out beyond what it lies on
  double ledge_height_mm = 0.0;  ///< above the bed
  double bridge_mm = 0.0;  ///< longest straight line over a hole that is closed, or made narrower
  double bridge_height_mm = 0.0;
  double lean_rad = 0.0;  ///< of the flanks of twisted teeth, from the vertical, at the tips
};

/// As the part lies on its lower or on its upper face. What lies no more than `carried_mm` above a
/// face of the part is carried by it, as by a support; teeth by tips under them.
[[nodiscard]] Overhang overhang(const PartShape& part, bool upside_down, double carried_mm = 0.0);
/// The same as a process prints it: carried by what is a layer below.
[[nodiscard]] Overhang overhang(const PartShape& part, bool upside_down, const Process& process);

/// The worst of it, of what a process makes without support: above 1 it wants some. 0: a process
/// without such limits.
[[nodiscard]] double overhang_share(const Overhang& overhang, const Process& process);

}  // namespace trueflank
