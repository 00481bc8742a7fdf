// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/axial_thrust.h"

#include <algorithm>
#include <cmath>

namespace trueflank {
AxialThrust axial_thrust(const GearTrain& train, const DirectionEfficiency& forward) {
  AxialThrust thrust;
  const Topology& topology = train.topology();
  // bodies in the order in which their gears come
  std::vector<int> members;
  for (const TopologyGear& gear : topology.gears)
    if (std::find(members.begin(), members.end(), gear.member) == members.end()) {
      members.push_back(gear.member);
      thrust.bodies.push_back({topology.name_of(gear.member), 0.0});
    }
  for (std::size_t k = 0; k < train.meshes.size() && k < forward.meshes.size(); ++k) {
    const GearPair pair = train.pair(train.meshes[k]);
    const TopologyMesh& gears = topology.meshes[k];
    const double planets = std::max(train.copies_of(topology.gears[static_cast<std::size_t>(gears.gear1)].member),
                                    train.copies_of(topology.gears[static_cast<std::size_t>(gears.gear2)].member));
    const auto& flow = forward.meshes[k];
    const double sign = flow.torque1 < 0.0 ? -1.0 : 1.0;
    const double pull = sign * 0.5 *
                        (std::abs(flow.torque1) / base_radius_mm(pair.gear1()) +
                         std::abs(flow.torque2) / base_radius_mm(pair.gear2())) *
                        1e3 / planets;
    const double lean = std::tan(base_helix_angle_rad(pair.gear1()));
    // 0.0 - x: no negative zero for spur teeth
    const double force = train.design.herringbone ? 0.0 : 0.0 - pull * lean;
    thrust.meshes.push_back({train.meshes[k].name, force});
    const auto add = [&](int gear, double each) {
      const int member = topology.gears[static_cast<std::size_t>(gear)].member;
      const auto place = std::find(members.begin(), members.end(), member) - members.begin();
      thrust.bodies[static_cast<std::size_t>(place)].n_per_nm +=
          topology.is_planet(member) ? each : each * planets;
    };
    add(train.meshes[k].gear1, force);
    add(train.meshes[k].gear2, -force);
  }
  return thrust;
}

}  // namespace trueflank
