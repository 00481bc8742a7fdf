// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/inertia.h"

#include <cmath>
#include <limits>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

double square(double x) { return x * x; }

/// Kinetic energy of everything but the output member, per half the square of the input speed.
double input_side(const GearTrain& train, const BodyInertias& bodies) {
  const Topology& topology = train.topology();
  double inertia = 0.0;
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    const int member = static_cast<int>(m);
    if (member == topology.output) continue;
    double of_body = bodies[m].axial_kg_m2 * square(train.speeds.of[m]);
    if (topology.is_planet(member))
      of_body += bodies[m].mass_kg * square(train.axis_distance_mm(member) * 1e-3 * train.speeds.of_arm(topology.carrier_of(member)));
    inertia += train.copies_of(member) * of_body;
  }
  return inertia;
}

}  // namespace

ReflectedInertia reflected_inertia(const GearTrain& train, const EfficiencyResult& efficiency,
                                   const BodyInertias& bodies, const ShaftLoads& loads) {
  ReflectedInertia r;
  if (train.meshes.empty()) return r;
  TRUEFLANK_EXPECTS(bodies.size() == train.topology().members.size());
  const double g = std::abs(train.speeds.output);  // output speed per input speed
  const double m1 = input_side(train, bodies) + loads.rotor_kg_m2;
  const double m2 = bodies[static_cast<std::size_t>(train.topology().output)].axial_kg_m2 + loads.load_kg_m2;
  r.input_side_kg_m2 = m1;
  r.output_side_kg_m2 = m2;
  r.at_input_lossless_kg_m2 = m1 + g * g * m2;
  r.at_output_lossless_kg_m2 = m1 / (g * g) + m2;
  // Of the meshes: what drags beside them is a torque of its own, and no factor.
  const double forward = std::isnan(efficiency.mesh_forward) ? efficiency.forward : efficiency.mesh_forward;
  const double backward = std::isnan(efficiency.mesh_backward) ? efficiency.backward : efficiency.mesh_backward;
  r.at_input_forward_kg_m2 = m1 + g * g / forward * m2;
  r.at_output_forward_kg_m2 = forward / (g * g) * m1 + m2;
  r.at_input_backward_kg_m2 = m1 + backward * g * g * m2;
  r.at_output_backward_kg_m2 =
      efficiency.self_locking ? std::numeric_limits<double>::infinity()
                              : m1 / (backward * g * g) + m2;
  if (!std::isnan(loads.drag_torque_nm))
    r.starting_torque_nm = efficiency.self_locking ? std::numeric_limits<double>::infinity()
                                                   : loads.drag_torque_nm / (g * backward);
  return r;
}

double inclined_surface_backward_efficiency(double forward) {
  return forward > 0.5 ? 2.0 - 1.0 / forward : 0.0;
}

}  // namespace trueflank
