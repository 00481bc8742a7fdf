// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/finding.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {

/// The forces between gears, pins and bearings at the output's torque.
struct MachineLoads {
  double output_torque_nm = kNaN;
  double pin_force_n = kNaN;       ///< on the pin of one planet
  double planet_speed_rpm = kNaN;  ///< of a planet against the carrier
};
[[nodiscard]] MachineLoads machine_loads(const GearTrain& train);

/// Findings about the parts around the gears of a design with [housing] (docs/gearbox.md):
/// housing_size, wall, screws, shaft_grip, bearing_seat, bearing_load, collision, assembly_order. None of
/// another design.
[[nodiscard]] Findings check_machine(const GearTrain& train, const PartShapes& shapes);

}  // namespace trueflank
