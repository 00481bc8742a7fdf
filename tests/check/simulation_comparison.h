// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace trueflank::test {

/// What the overlap check and the brute-force simulation said of random designs.
struct Comparison {
  int designs = 0, meshes = 0;
  int external = 0, fillet_rings = 0, shaper_rings = 0, undercut = 0, thinned = 0, compound = 0;
  int failing = 0;      ///< meshes that penetrate by more than the grey zone, both agreeing
  int grey = 0;         ///< within the grey zone of touching: no verdict is wrong there
  int wrong = 0;        ///< verdicts that differ outside the grey zone
  int exact_wrong = 0;  ///< polygons whose exact verdict contradicts the sweep beyond their chord error
  double largest_difference_mm = 0.0;  ///< of the two clearances where both see one
};

inline constexpr double kGreyZone_mm = 1e-3;  // 1 um at module 1

/// Compares the first `designs` random designs that can be laid out, from a seed on.
/// Prints every disagreement.
[[nodiscard]] Comparison compare_with_simulation(std::uint64_t first_seed, int designs);

}  // namespace trueflank::test
