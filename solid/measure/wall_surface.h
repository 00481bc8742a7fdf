// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <variant>

#include "trueflank/solid/measure/toothing_distance.h"

namespace trueflank {

/// Distances in space from a circle's or bore's wall with its bed chamfer, as ToothingDistance gives
/// them for teeth. Frame: the part's.
/// Accuracy: 1e-9 mm at points on the wall.
class BedDistance {
 public:
  /// Requires: an outline without teeth.
  explicit BedDistance(const Outline& outline);

  [[nodiscard]] double distance_mm(const Point3& point) const;
  [[nodiscard]] double lower_bound_mm(const Point3& point) const;
  [[nodiscard]] double undisplaced_z_mm(const Point3& point) const { return point.z(); }
  [[nodiscard]] Point2 point_at_height(std::size_t piece, double parameter, int copy,
                                       double z_mm) const;
  [[nodiscard]] std::vector<double> breaks_at_height(std::size_t, int, double) const { return {}; }
  [[nodiscard]] double slope_share(std::size_t piece, double parameter, int copy,
                                   double z_mm) const;

 private:
  [[nodiscard]] double slope_at(double z_mm) const;

  Outline outline_;
  BedChamfer bed_;
  OutlineDistance above_;  ///< of the outline without its chamfer
};

/// The wall of an outline that is no prism, with teeth or without.
using WallSurface = std::variant<ToothingDistance, BedDistance>;

/// @name As the members of ToothingDistance
/// @{
[[nodiscard]] double distance_mm(const WallSurface& wall, const Point3& point);
[[nodiscard]] double lower_bound_mm(const WallSurface& wall, const Point3& point);
[[nodiscard]] double undisplaced_z_mm(const WallSurface& wall, const Point3& point);
[[nodiscard]] Point2 point_at_height(const WallSurface& wall, std::size_t piece, double parameter,
                                     int copy, double z_mm);
[[nodiscard]] std::vector<double> breaks_at_height(const WallSurface& wall, std::size_t piece,
                                                   int copy, double z_mm);
[[nodiscard]] double slope_share(const WallSurface& wall, std::size_t piece, double parameter,
                                 int copy, double z_mm);
/// @}

/// Nothing where the wall is a prism from a height of the part on.
[[nodiscard]] std::optional<WallSurface> wall_surface(const Outline& outline, double from_z_mm);

}  // namespace trueflank
