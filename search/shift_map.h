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
  /// Distances to the limits, in the order of ShiftSurface::limits, each as `efficiency`; what the
  /// optimiser keeps in reserve (the clearance of corners) is off. Below 0: broken. From -2 to 2.
  std::vector<std::vector<double>> margins;
  [[nodiscard]] bool feasible(std::size_t point) const;
  /// The limit that is kept least there.
  [[nodiscard]] std::size_t nearest_limit(std::size_t point) const;
};

/// A piece of a limit's border between two points of a map: values along `across` and `up`.
struct BorderPiece {
  std::array<double, 2> from{}, to{};
};
/// Where a limit turns from kept to broken, beside places that keep every limit; in a map without
/// such places everywhere.
/// Accuracy: straight between the map's points, and each point linear between its neighbours.
[[nodiscard]] std::vector<BorderPiece> limit_border(const ShiftMap& map, std::size_t limit);

struct ShiftSurface {
  FreeShifts best;           ///< of the first objective; without feasible shifts the nearest to it
  double efficiency = kNaN;  ///< there; NaN: no shifts keep all limits
  std::vector<LimitEntry> limits;  ///< SearchTrain::limits, then the bounds of the free shifts
  std::vector<ShiftMap> maps;  ///< one per pair of free variables; what is feasible and some beyond
};

/// Of the first objective, over all shifts of a set; NaN: none keep all limits.
[[nodiscard]] double best_efficiency(const SearchRequirements& requirements, const ToothSet& set);

/// Requires: an efficiency is the first objective; `points` >= 2 per axis.
[[nodiscard]] ShiftSurface shift_surface(const SearchRequirements& requirements,
                                         const ToothSet& set, int points);

}  // namespace trueflank
