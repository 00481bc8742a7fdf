// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/inertia.h"

#include <cmath>
#include <limits>

namespace trueflank {
namespace {

double square(double x) { return x * x; }

double output_body(const GearTrain& train, const BodyInertias& bodies) {
  switch (train.design.output) {
    case OutputMember::kRing2: return bodies.ring2_kg_m2;
    case OutputMember::kCarrier: return bodies.carrier_kg_m2;
    default: return bodies.ring1_kg_m2;  // ring1, ring, wheel
  }
}

/// Kinetic energy of everything but the output member, per half the square of the input speed.
double input_side(const GearTrain& train, const MemberSpeeds& speed, const BodyInertias& bodies) {
  double inertia = bodies.sun_kg_m2;
  if (train.design.kind == TrainKind::kPair) return inertia;
  const double orbit_m = train.centre_distance_mm * 1e-3;
  inertia += train.design.planets * (bodies.planet_kg_m2 * square(speed.planet) +
                                     bodies.planet_mass_kg * square(orbit_m * speed.carrier));
  if (train.design.output != OutputMember::kCarrier)
    inertia += bodies.carrier_kg_m2 * square(speed.carrier);
  return inertia;
}

}  // namespace

ReflectedInertia reflected_inertia(const GearTrain& train, const EfficiencyResult& efficiency,
                                   const BodyInertias& bodies, const ShaftLoads& loads) {
  ReflectedInertia r;
  if (train.design.kind == TrainKind::kGear) return r;
  const MemberSpeeds speed = member_speeds(train);
  const double g = std::abs(speed.output);  // output speed per input speed
  const double m1 = input_side(train, speed, bodies) + loads.rotor_kg_m2;
  const double m2 = output_body(train, bodies) + loads.load_kg_m2;
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
