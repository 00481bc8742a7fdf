// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Centre distance and every gear's profile shift.
struct ShiftSolution {
  double centre_distance_mm = kNaN;         ///< NaN for a single gear
  std::vector<double> shifts;               ///< in the order of the design's gears
  std::vector<double> implied_backlash_mm;  ///< per mesh: what the given values imply; 0 where solved
};

/// Omitted shifts are solved for zero backlash at the centre distance; an omitted centre distance
/// is that of the first mesh whose shifts are both given. What nothing determines: planets (and the
/// pinion of an internal pair) take 0, an external pair shares its sum evenly; without a centre
/// distance all free shifts are 0. Errors: kInconsistent, kInfeasible, all of them.
/// `meshes` need only names and gear indices.
[[nodiscard]] ResultAll<ShiftSolution> solve_shifts(const GearboxDesign& design,
                                                    const std::vector<TrainMesh>& meshes);

}  // namespace trueflank
