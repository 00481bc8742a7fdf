// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/machine_loads.h"

#include <cmath>
#include <vector>

#include "trueflank/train/efficiency_balance.h"

namespace trueflank {

MachineLoads machine_loads(const GearTrain& train) {
  MachineLoads loads;
  const MachineDesign& machine = *train.design.machine;
  const Topology& topology = train.topology();
  std::vector<int> teeth;
  for (const TrainGear& gear : train.gears)
    teeth.push_back(gear.profile.gear().kind == GearKind::kInternal ? -gear.profile.gear().teeth
                                                                    : gear.profile.gear().teeth);
  const BalanceState state =
      solve_balance(balance_train(topology, teeth), DriveDirection::kForward);
  const auto output = static_cast<std::size_t>(topology.output),
             input = static_cast<std::size_t>(topology.input);
  const double ratio = std::abs(state.torque[output] / state.torque[input]);
  loads.output_torque_nm = machine.output.torque_nm.value_or(machine.motor.torque_nm * ratio);
  const double driving_nm = loads.output_torque_nm / ratio;
  if (!topology.has_planets()) return loads;
  // on a planet: along each mesh's line of action, across the radius to the planet
  double across = 0.0, along = 0.0;
  for (std::size_t i = 0; i < train.meshes.size(); ++i) {
    const TrainMesh& mesh = train.meshes[i];
    const bool first = topology.is_planet_gear(static_cast<std::size_t>(mesh.gear1));
    const TrainGear& planet = train.gear(first ? mesh.gear1 : mesh.gear2);
    const double torque = (first ? state.meshes[i].torque1 : state.meshes[i].torque2) * driving_nm;
    const double working = working_pressure_angle_rad(train.pair(mesh));
    const double pitch_mm = base_radius_mm(planet.profile.gear()) / std::cos(working);
    const double tangential = 1000.0 * torque / train.design.planets / pitch_mm;
    const bool ring = train.gear(mesh.gear2).profile.gear().kind == GearKind::kInternal;
    across += ring ? tangential : -tangential;
    along += (ring ? -1.0 : 1.0) * std::abs(tangential) * std::tan(working);
  }
  loads.pin_force_n = std::hypot(across, along);
  const int planet = topology.first_planet();
  const auto& speed = state.speed;
  const double relative = speed[static_cast<std::size_t>(planet)] -
                          speed[static_cast<std::size_t>(topology.carrier_of(planet))];
  loads.planet_speed_rpm = std::abs(relative / speed[output]) * machine.output.speed_rpm;
  return loads;
}

WheelForces wheel_forces(const GearTrain& train, double torque_nm) {
  const TrainMesh& mesh = train.meshes.front();
  const TrainGear& wheel = train.gear(mesh.gear2);
  const double base_mm = base_radius_mm(wheel.profile.gear());
  // without friction the whole force is along the line of action, on the base circle
  const double across = 1000.0 * torque_nm / base_mm;
  const double along =
      wheel.twist.herringbone ? 0.0 : across * base_mm * std::abs(wheel.twist.turn_rad_per_mm);
  const double pitch_mm = base_mm / std::cos(working_pressure_angle_rad(train.pair(mesh)));
  return {.across_n = across, .along_n = along, .tilting_nmm = along * pitch_mm};
}

}  // namespace trueflank
