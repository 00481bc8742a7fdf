// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "trueflank/base/units.h"
#include "trueflank/train/gearbox_design.h"

// Losses beside the friction of the meshes as designed: measured on a bench, kept in the design.
namespace trueflank {

/// Where a drive runs.
struct DrivePoint {
  bool forward = true;     ///< the input drives
  double speed_rpm = 0.0;  ///< of the input
  double load_nm = 0.0;    ///< the driving torque as the lossless drive passes it to the input
  double temperature_c = kNaN;  ///< NaN: the losses' reference
};

/// Friction coefficient of the meshes at a point.
[[nodiscard]] double mesh_friction(const LossesDesign& losses, double friction, const DrivePoint& point);
/// Torque lost at the input beside the meshes [N m]; `carried_nm`: the output's torque as the lossless
/// drive passes it to the input.
[[nodiscard]] double loss_torque_nm(const LossesDesign& losses, const DrivePoint& point,
                                    double carried_nm);

struct LossyEfficiency {
  double forward = kNaN, backward = kNaN;  ///< 0 where the losses hold the drive at this load
  double friction_forward = kNaN, friction_backward = kNaN;
  double loss_forward_nm = kNaN, loss_backward_nm = kNaN;  ///< at the input
};
/// Efficiencies of the meshes alone for a friction forward and one backward.
using MeshEfficiencies = std::function<std::pair<double, double>(double forward, double backward)>;
/// Efficiencies at the operating point of the losses.
[[nodiscard]] LossyEfficiency lossy_efficiency(const LossesDesign& losses, double friction,
                                               double ratio, const MeshEfficiencies& meshes);

}  // namespace trueflank
