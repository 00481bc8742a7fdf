// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// A change of a design, in modules, coefficients and counts; the joint cure's unknowns.
struct DesignChange {
  double centre_distance = 0.0;          ///< modules
  double backlash = 0.0;                 ///< modules
  double root_radius = 0.0, addendum = 0.0;
  std::map<int, double> shift_of_layer;  ///< of the layer's leading gear; its mates follow
  std::vector<int> teeth;                ///< of each gear; empty: none
  int planets = 0;
  double layer_gap_mm = 0.0;
  std::map<std::size_t, double> tip_diameter_mm;  ///< of gear index, as it shall be

  [[nodiscard]] bool moves_shifts() const;
  /// Without the tips; see joint_cure.h.
  [[nodiscard]] double cost() const;
};

/// Modules; a shift solved for a centre distance farther off than this says nothing at the new one.
inline constexpr double kFarCentreDistance = 0.5;

/// The gear of a layer whose shift is free: the one with most meshes, the first of them.
[[nodiscard]] std::size_t leading_gear(const GearTrain& train, int layer);
/// Layers that have meshes.
[[nodiscard]] std::vector<int> meshing_layers(const GearTrain& train);

/// The design changed. Shifts are kept as they are given, or, where anything about them moves, those of the
/// leading gears are set and the others left open, to be solved without backlash of their own. `fits`: the given
/// shifts and centre distance fit each other.
[[nodiscard]] GearboxDesign changed_design(const GearTrain& train, const DesignChange& change, bool fits);

}  // namespace trueflank
