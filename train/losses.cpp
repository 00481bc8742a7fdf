// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/losses.h"

#include <algorithm>
#include <cmath>

namespace trueflank {

double mesh_friction(const LossesDesign& losses, double friction, const DrivePoint& point) {
  double mu = point.forward ? friction : losses.backward_friction.value_or(friction);
  if (losses.load_friction != 0.0)
    mu += losses.load_friction *
          std::pow(std::max(point.load_nm, 0.0) / losses.load_friction_reference_nm,
                   losses.load_friction_exponent);
  if (losses.mixed_friction != 0.0) {
    const double x = point.speed_rpm / losses.mixed_friction_speed_rpm;
    mu += losses.mixed_friction * std::exp(-x * x);
  }
  return std::max(mu, 0.0);
}

double loss_torque_nm(const LossesDesign& losses, const DrivePoint& point, double carried_nm) {
  const double warmer =
      std::isnan(point.temperature_c) ? 0.0 : point.temperature_c - losses.reference_c;
  const double slow = point.speed_rpm / losses.stribeck_speed_rpm;
  return losses.drag_torque_nm * std::exp(-losses.drag_per_c * warmer) +
         losses.viscous_nm_per_rpm * point.speed_rpm * std::exp(-losses.viscous_per_c * warmer) +
         losses.bearing_nm_at_1000_rpm * std::pow(point.speed_rpm / 1000.0, 2.0 / 3.0) +
         losses.stribeck_torque_nm * std::exp(-slow * slow) + losses.bearing_load_share * carried_nm;
}

LossyEfficiency lossy_efficiency(const LossesDesign& losses, double friction, double ratio,
                                 const MeshEfficiencies& meshes) {
  const double carried = losses.load_nm / ratio;
  const double temperature = losses.temperature_c.value_or(losses.reference_c);
  DrivePoint forward{true, losses.input_speed_rpm, carried, temperature};
  const DrivePoint backward{false, losses.input_speed_rpm, carried, temperature};
  LossyEfficiency result;
  result.friction_backward = mesh_friction(losses, friction, backward);
  result.loss_forward_nm = loss_torque_nm(losses, forward, carried);
  result.loss_backward_nm = loss_torque_nm(losses, backward, carried);
  // The input's torque decides the friction and follows from it: a few rounds settle it.
  for (int round = 0; round < 20; ++round) {
    result.friction_forward = mesh_friction(losses, friction, forward);
    const double mesh = meshes(result.friction_forward, result.friction_backward).first;
    result.forward = mesh > 0.0 ? carried / (carried / mesh + result.loss_forward_nm) : 0.0;
    if (!(result.forward > 0.0)) break;
    const double load = carried / result.forward;
    if (std::abs(load - forward.load_nm) < 1e-12 * load) break;
    forward.load_nm = load;
  }
  const double mesh = meshes(result.friction_forward, result.friction_backward).second;
  result.backward = std::max(0.0, mesh - result.loss_backward_nm / carried);
  return result;
}

}  // namespace trueflank
