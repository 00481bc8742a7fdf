// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/train/efficiency_balance.h"

namespace trueflank {

/// What a bound knows of a tooth set.
enum class BoundBy {
  kOutlines,  ///< tip circles, clearances, contact ratios: a hundredth of the work of optimise_set
  kProfiles,  ///< the corners in the roots too: a hundredth more
  kHalving,   ///< and on finer grids where the bound is highest: a tenth
};

/// An efficiency that no shifts of a tooth set exceed; below 0 where they cannot keep the limits.
/// By halving a bound that has come below `enough` is not brought down further.
/// Not guaranteed: it stands on a grid, with room for what lies between its points (measured, not
/// proved): tests compare with optimise_set on sets of every kind.
/// Requires: an efficiency of the meshes alone, without the losses of a `[losses]` table.
[[nodiscard]] double efficiency_bound(const SearchRequirements& requirements, const ToothSet& set,
                                      DriveDirection direction, BoundBy by,
                                      double enough = 0.0);

}  // namespace trueflank
