// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/train_turning.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"

namespace trueflank {
namespace {

constexpr int kPositions = 8;

/// A gear 1 and a gear 2 as they stand; the direction from the axis of gear 1 to the mesh.
struct Standing {
  double rotation1_rad, rotation2_rad, direction_rad;
};

Standing standing(const GearTrain& train, const AssemblyPhases& phases, const TrainMesh& mesh,
                  std::size_t place) {
  const Topology& topology = train.topology();
  const auto rotation = [&](int gear) {
    return phases.rotation_rad(topology.gears[static_cast<std::size_t>(gear)].member, place) +
           phases.offset_rad(gear, place);
  };
  const bool with_planet = topology.is_planet_gear(static_cast<std::size_t>(mesh.gear1)) ||
                           topology.is_planet_gear(static_cast<std::size_t>(mesh.gear2));
  return {rotation(mesh.gear1), rotation(mesh.gear2),
          with_planet ? phases.positions_rad(topology.first_planet())[place] : 0.0};
}

/// How far gear 2 is turned out of the position in which a tooth of one faces a gap of the other.
double phase_error_rad(const GearPair& pair, const Standing& s) {
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  const double phase1 = z1 * (s.rotation1_rad - s.direction_rad);
  const double phase2 = pair.internal() ? -z2 * (s.rotation2_rad - s.direction_rad)
                                        : z2 * (s.rotation2_rad - s.direction_rad - kPi);
  return centred_rad(phase1 + phase2 - kPi) / z2;
}

}  // namespace

TrainTurning turn_train(const GearTrain& train, const std::vector<MeshState>& states) {
  TrainTurning worst;
  if (train.meshes.empty()) return worst;
  const std::size_t planets =
      std::max<std::size_t>(train.phases.positions_rad(train.topology().first_planet()).size(), 1);
  std::size_t worst_mesh = 0;
  double worst_rad = 0.0;
  for (int k = 0; k < kPositions; ++k) {
    const AssemblyPhases phases = turned(train, 0.1 * kTwoPi * k);
    for (std::size_t m = 0; m < train.meshes.size(); ++m) {
      const GearPair pair = train.pair(train.meshes[m]);
      for (std::size_t i = 0; i < planets; ++i) {
        const double error = std::abs(phase_error_rad(pair, standing(train, phases, train.meshes[m], i)));
        const double arc = error * pitch_radius2_mm(pair);
        if (arc <= worst.phase_error_mm && !worst.mesh.empty()) continue;
        worst_mesh = m;
        worst_rad = error;
        worst.phase_error_mm = arc;
        worst.mesh = train.meshes[m].name + " of planet " + std::to_string(i + 1);
      }
    }
  }
  worst.clearance_mm = states[worst_mesh].centred.clearance_mm;
  if (worst.phase_error_mm > tolerance::kTouch_mm)
    worst.clearance_mm = mesh_clearance(train.pair(train.meshes[worst_mesh]), worst_rad).clearance_mm;
  return worst;
}

}  // namespace trueflank
