// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/axial_thrust.h"

#include <algorithm>
#include <cmath>

namespace trueflank {
namespace {

/// planet1 and planet2 are one body.
std::string body_of(const std::string& gear) {
  return gear.starts_with("planet") ? "planet" : gear;
}

}  // namespace

AxialThrust axial_thrust(const GearTrain& train, const DirectionEfficiency& forward) {
  AxialThrust thrust;
  for (const TrainGear& gear : train.gears) {
    const std::string body = body_of(gear.name);
    const auto known = std::find_if(thrust.bodies.begin(), thrust.bodies.end(),
                                    [&](const auto& b) { return b.name == body; });
    if (known == thrust.bodies.end()) thrust.bodies.push_back({body, 0.0});
  }
  const bool planetary = train.design.kind == TrainKind::k3k || train.design.kind == TrainKind::kSimple;
  const double planets = planetary ? train.design.planets : 1;
  for (std::size_t k = 0; k < train.meshes.size() && k < forward.meshes.size(); ++k) {
    const GearPair pair = train.pair(train.meshes[k]);
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
      const std::string& name = train.gears[static_cast<std::size_t>(gear)].name;
      const std::string body = body_of(name);
      for (auto& b : thrust.bodies)
        if (b.name == body) b.n_per_nm += body == "planet" ? each : each * planets;
    };
    add(train.meshes[k].gear1, force);
    add(train.meshes[k].gear2, -force);
  }
  return thrust;
}

}  // namespace trueflank
