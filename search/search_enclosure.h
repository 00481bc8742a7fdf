// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/search/search_interval.h"
#include "trueflank/search/search_model.h"

// What the limits and losses of one layer can be anywhere in a box of centre distances and shifts:
// the same relations as search_model.h, written once more for numbers that enclose. Derivation:
// docs/decisions/0175-certified-bound.md.
namespace trueflank {

/// Ranges of the centre distance and of a layer's free shift, in modules of layer 1 and of the
/// layer.
struct LayerBox {
  Interval distance, shift;
  std::size_t which =
      1;  ///< the shift's place among the variables: 1 or 2 (0: the centre distance)
};

/// Of one layer in a box.
struct LayerEnclosure {
  bool possible = true;  ///< false: proved that no point of the box keeps every limit
  /// Efficiencies of the meshes, of the side that drives, wherever the limits are kept; at the
  /// box's middle, as if they were.
  Slope sun_planet{1.0}, planet_ring{1.0};
  Interval sun_planet_middle{1.0}, planet_ring_middle{1.0};
};

/// A layer's tooth numbers, what is asked of it, and which gear of a mesh drives.
struct EnclosedLayer {
  int sun = 0, planet = 0, ring = 0;  ///< 0: no such gear
  int planets = 1;
  double module = 1.0;           ///< over that of layer 1
  double least_module_mm = 1.0;  ///< of the layer
  bool sun_drives = true, planet_drives_ring = true;
};

/// Guarantees: a point of the box that keeps every limit to within kLooseLimit is never ruled out,
/// and the meshes' efficiencies there lie within the enclosures.
[[nodiscard]] LayerEnclosure enclose(const SearchRequirements& requirements,
                                     const EnclosedLayer& layer, const LayerBox& box);

/// Limits are loosened by this, in modules: more than rounding, and than what the model's samples
/// of a root curve miss of a corner's distance (docs/accuracy.md).
inline constexpr double kLooseLimit = 1e-7;

}  // namespace trueflank
