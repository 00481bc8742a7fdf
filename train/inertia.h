// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

/// Inertia of one body about its own axis; solid/measure/mass_properties.h computes it from the solids.
struct BodyInertia {
  double axial_kg_m2 = 0.0;
  double mass_kg = 0.0;  ///< of a planet: it goes round with the carrier
};
/// In the order of Topology::members; of planets one body.
using BodyInertias = std::vector<BodyInertia>;

/// What hangs on the shafts besides.
struct ShaftLoads {
  double rotor_kg_m2 = 0.0;   ///< motor's rotor, on the input
  double load_kg_m2 = 0.0;    ///< on the output
  double drag_torque_nm = kNaN;  ///< load-independent, at the input; NaN: not known
};

/// Inertia as either shaft feels it, in the model of two movers on an inclined surface: what turns with
/// the input (rotor, sun, planets, carrier) is one, the output with its load the other, all mesh loss
/// lies between. Infinite where backward driving is self-locking.
/// Source: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403, section II; backward
/// equivalents from the same force balance (docs/efficiency.md).
struct ReflectedInertia {
  double input_side_kg_m2 = kNaN;   ///< of all that turns with the input, at the input
  double output_side_kg_m2 = kNaN;  ///< of output member and load, at the output
  double at_input_lossless_kg_m2 = kNaN, at_output_lossless_kg_m2 = kNaN;
  double at_input_forward_kg_m2 = kNaN, at_output_forward_kg_m2 = kNaN;
  double at_input_backward_kg_m2 = kNaN, at_output_backward_kg_m2 = kNaN;
  /// Torque at the output that starts the train backwards against the drag torque; NaN where that is
  /// not known, infinite where the train locks.
  double starting_torque_nm = kNaN;
};

/// NaN throughout for a single gear.
[[nodiscard]] ReflectedInertia reflected_inertia(const GearTrain& train,
                                                 const EfficiencyResult& efficiency,
                                                 const BodyInertias& bodies,
                                                 const ShaftLoads& loads = {});

/// Backward efficiency of a slow output (ratio far above 1) by the rule of the inclined surface:
/// 2 - 1/eta above one half, else 0.
[[nodiscard]] double inclined_surface_backward_efficiency(double forward);

}  // namespace trueflank
