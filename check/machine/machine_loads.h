// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/gear_train.h"

namespace trueflank {

/// The forces between gears, pins and bearings at the output's torque.
struct MachineLoads {
  double output_torque_nm = kNaN;
  double pin_force_n = kNaN;       ///< on the pin of one planet
  double planet_speed_rpm = kNaN;  ///< of a planet against the carrier
};
[[nodiscard]] MachineLoads machine_loads(const GearTrain& train);

/// What the teeth of a pair do to the wheel at a torque on it.
struct WheelForces {
  double across_n = 0.0;     ///< tangential and radial part together
  double along_n = 0.0;      ///< of helical teeth; of herringbone ones 0
  double tilting_nmm = 0.0;  ///< of the force along the axis, which acts on the pitch circle
};
[[nodiscard]] WheelForces wheel_forces(const GearTrain& train, double torque_nm);

}  // namespace trueflank
