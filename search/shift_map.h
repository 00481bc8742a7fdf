// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "trueflank/search/search_model.h"
#include "trueflank/search/search_requirements.h"

// The efficiency of one tooth set over its free variables, with what forbids each place.
namespace trueflank {

/// A free variable of a tooth set.
enum class MapAxis { kCentreDistance, kLayer1Shift, kLayer2Shift };

/// The efficiency over two of the free variables, the third as at the best place.
struct ShiftMap {
  MapAxis across = MapAxis::kCentreDistance, up = MapAxis::kLayer1Shift;
  std::vector<double> x, y;  ///< [modules]
  std::vector<double>
      efficiency;  ///< x fastest; NaN where teeth do not exist or contact is interrupted
  /// Distances to the limits, in the order of SearchTrain::limits, each as `efficiency`; what the
  /// optimiser keeps in reserve (the clearance of corners) is off. Below 0: broken.
  std::vector<std::vector<double>> margins;
  [[nodiscard]] bool feasible(std::size_t point) const;
  /// The limit that is kept least there.
  [[nodiscard]] std::size_t nearest_limit(std::size_t point) const;
};

struct ShiftSurface {
  FreeShifts best;           ///< of the first objective; without feasible shifts the nearest to it
  double efficiency = kNaN;  ///< there; NaN: no shifts keep all limits
  std::vector<ShiftMap> maps;  ///< one per pair of free variables; they cover what is feasible
};

/// Requires: an efficiency is the first objective; `points` >= 2 per axis.
[[nodiscard]] ShiftSurface shift_surface(const SearchRequirements& requirements,
                                         const ToothSet& set, int points);

}  // namespace trueflank
