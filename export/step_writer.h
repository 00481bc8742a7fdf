// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/shape/part_shape.h"

// STEP AP214 text (ISO 10303-21 and -214): exact B-rep solids, an assembly of shared parts.
namespace trueflank::io {

struct StepPart {
  std::string name;  ///< of the product
  Brep solid;
  std::array<double, 3> colour{0.7, 0.7, 0.7};  ///< red, green, blue as a screen shows them (sRGB)
};

/// One part as a product of its own.
/// Guarantees: mm; the same part gives the same bytes (the header's time is fixed); coordinates are
/// written to 1e-10 mm.
[[nodiscard]] std::string step_text(const StepPart& part);

/// An assembly: every part once, used as often as placed.
/// Requires: Placement::part is an index into parts.
[[nodiscard]] std::string step_text(const std::vector<StepPart>& parts,
                                    const std::vector<Placement>& placements,
                                    const std::string& name);

}  // namespace trueflank::io
