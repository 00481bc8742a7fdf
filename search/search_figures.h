// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/train/gear_train.h"

// The figures a design is ranked by or held to, beside its efficiency.
namespace trueflank {

/// An objective as files and pages name it.
struct ObjectiveEntry {
  SearchObjective objective;
  const char* name;       ///< in `[search] objectives`
  const char* column;     ///< in search.csv and search.json
  const char* title;      ///< with its unit
  const char* limit_key;  ///< in the requirements file, with its table; "": none
  bool larger_is_better;
};
/// All but kWeighted, in a fixed order.
[[nodiscard]] const std::vector<ObjectiveEntry>& objective_entries();
[[nodiscard]] const ObjectiveEntry& objective_entry(SearchObjective objective);

/// What a laid-out design is; NaN where the requirements do not say enough.
struct DesignFigures {
  double mass_kg = kNaN;    ///< of all gears, solid
  double length_mm = kNaN;  ///< of the gears along the axis
  double torque_density_nm_per_kg = kNaN;
  /// Torque at the output that starts the train backwards against the drag at rest of `[losses]`.
  double starting_torque_nm = kNaN;
  /// Of gears, rotor and load, at the input driven forward; at the output driven backward.
  double input_inertia_kg_m2 = kNaN, output_inertia_kg_m2 = kNaN;
  double contact_ratio = kNaN;  ///< least of the meshes, of what undercut and roots leave
  double sliding = kNaN;        ///< greatest specific sliding of any tooth, as a magnitude
  double backlash_arcmin = kNaN;  ///< of the output, the input held, every mesh with its backlash
  double acceleration_rad_s2 = kNaN;  ///< of the load from rest, under the motor's torque
  double settling_s = kNaN;           ///< from rest to rest over the move asked for
};

/// Requires: a train of at least one mesh; `torque_nm` is what it can carry at the output; the
/// efficiencies are those of the meshes alone.
/// Accuracy: mass and inertia 1e-4 of those of the solids, tested against them.
[[nodiscard]] DesignFigures design_figures(const SearchRequirements& requirements,
                                           const GearTrain& train, double mesh_forward,
                                           double mesh_backward, double torque_nm);

/// The figure of an objective; NaN of those that are none of DesignFigures.
[[nodiscard]] double figure_of(const DesignFigures& figures, SearchObjective objective);

/// Torque at the input that the losses take where nothing turns; NaN without `[losses]`.
[[nodiscard]] double drag_at_rest_nm(const SearchRequirements& requirements);

}  // namespace trueflank
