// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "trueflank/check/tolerance_analysis.h"

// Tolerances that a design itself names, or its process keeps.
namespace trueflank {

struct DesignTolerances {
  ToleranceOptions options;
  bool asked = false;     ///< by the design: what jams fails; the process's own only warn
  std::string text = {};  ///< "ISO class 7, axes +-10 um"
};
/// Nothing where neither the design nor its process says any. A class of the process counts for gears inside the
/// scope of ISO 1328-1 alone; where one is outside, its runout does.
[[nodiscard]] std::optional<DesignTolerances> design_tolerances(const GearTrain& train);

/// `tolerance` of the design's own tolerances, as check_tolerance(); empty without any. What only the process says
/// never fails a design. `not_applicable` with the reason where the tolerances cannot be taken.
[[nodiscard]] Findings check_design_tolerance(const GearTrain& train);

/// Backlash that every mesh lacks so that even the worst of the design's tolerances leaves the teeth free; 0 where
/// nothing fails.
[[nodiscard]] double lacking_backlash_mm(const GearTrain& train);

/// By how much the backlash of a design falls short of the clearance of flanks that it asks for; 0 where it does
/// not. It hangs on the pressure angle in mesh.
[[nodiscard]] double lacking_for_clearance_mm(const GearTrain& train);

}  // namespace trueflank
