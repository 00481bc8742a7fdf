// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// The design of a gear as the gearbox has it: the fixed ring reaches to the housing's lips and has
/// holes for its screws; a ring that drives out ends at its cup.
[[nodiscard]] GearDesign machine_gear(const MachineLayout& layout, const GearTrain& train,
                                      int gear);

/// Makes a gearbox of the gears' parts: hub, cup and bearing seats are added to sun, output ring
/// and planets; then come `carrier`, `carrier_top`, `carrier_pillar`, `housing`, `lid`, `retainer`,
/// `journal`, `output`, and what is bought (PartShape::bought).
/// Errors: kInfeasible, where no pin fits a planet.
[[nodiscard]] Errors add_machine(const GearTrain& train, const MachineLayout& layout,
                                 PartShapes& shapes);

}  // namespace trueflank
