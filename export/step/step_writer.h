// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/export/step/step_pmi.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/shape/part_shape.h"

// STEP text (ISO 10303-21) by AP214 or AP242: exact B-rep solids, an assembly of shared parts; by
// AP242 also sizes, limits, datum and runouts that a program can read.
namespace trueflank::io {

struct StepPart {
  std::string name;  ///< of the product
  Brep solid;
  std::array<double, 3> colour{0.7, 0.7, 0.7};  ///< red, green, blue as a screen shows them (sRGB)
  StepPmi pmi = {};  ///< written where the schema has words for it
};

/// One part as a product of its own.
/// Guarantees: mm; the same part gives the same bytes (the header's time is fixed); coordinates are
/// written to 1e-10 mm.
[[nodiscard]] std::string step_text(const StepPart& part, StepSchema schema = StepSchema::kAp214);

/// An assembly: every part once, used as often as placed.
/// Requires: Placement::part is an index into parts.
[[nodiscard]] std::string step_text(const std::vector<StepPart>& parts,
                                    const std::vector<Placement>& placements,
                                    const std::string& name,
                                    StepSchema schema = StepSchema::kAp214);

}  // namespace trueflank::io
