// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_listing.h"
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

/// An outer diameter [mm] that no shifts of a tooth set come below.
/// Not guaranteed: as above.
[[nodiscard]] double least_size_mm(const SearchRequirements& requirements, const ToothSet& set);

/// Whether bounds say something of everything that designs are ranked by: efficiencies, the outer
/// diameter and weighted products of them.
[[nodiscard]] bool has_bounds(const SearchRequirements& requirements);

/// What the meshes of a set do not exceed, in the directions that are ranked by.
struct MeshBounds {
  double forward = 1.0, backward = 1.0;
  [[nodiscard]] bool possible() const { return forward >= 0.0 && backward >= 0.0; }
  /// As efficiency_bound.
  void lower(const SearchRequirements& requirements, const ToothSet& set, BoundBy by,
             double enough = 0.0);
};

/// What that makes of the objectives, with the losses of a drive; infinite where nothing is known.
[[nodiscard]] Merits merit_bounds(const SearchRequirements& requirements, double ratio,
                                  const MeshBounds& meshes, double least_size_mm);

}  // namespace trueflank
