// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// A point of a flank: where it is on it [mm], and how far it lies off [um].
struct PointOfFlank {
  double along_mm = 0.0, up_mm = 0.0;  ///< along the involute from the base circle; height
  double um = 0.0;
};

/// Scanned flanks, less what those of a side have in common along lines over profile and face, and
/// what each has smoothly by itself.
struct LevelledFlanks {
  static constexpr std::size_t kFewestPoints = 60;  ///< with fewer a flank is not looked at

  std::vector<std::vector<PointOfFlank>> points;  ///< of flank 2 (tooth - 1), and 1 on of side +1
  double low_mm = 0.0, length_mm = 0.0, face_mm = 0.0;  ///< where the profile begins, its length
  double area_mm2 = 0.0, number = 0.0;                  ///< of flanks with enough points
  double sigma_um = 0.0;  ///< scatter of a point; 0: too few flanks were seen

  [[nodiscard]] bool has_enough(std::size_t flank) const {
    return points[flank].size() >= kFewestPoints;
  }
};

/// `fewest`: flanks that must have enough points.
[[nodiscard]] LevelledFlanks levelled_flanks(const FlankGeometry& geometry,
                                             const Observations& table, std::size_t fewest);

}  // namespace trueflank::loop
