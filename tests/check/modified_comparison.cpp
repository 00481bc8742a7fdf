// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/modified_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/check/mesh_simulation.h"
#include "tests/check/modified_designs.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank::test {
namespace {

constexpr double kGreyZone_mm = 1e-3;

/// By brute force, gear 2 turned; the smallest over the face, chamfered ends too, and where the check says
/// that it is.
double simulated(const GearTrain& train, double turn_rad, int heights, double told_z_mm) {
  const TrainGear &gear1 = train.gears[0], &gear2 = train.gears[1];
  const double width = std::min(gear1.face_width_mm, gear2.face_width_mm);
  double least = 1e300;
  for (int i = 0; i <= heights; ++i) {
    const double z = i == heights ? told_z_mm : width * i / (heights - 1);
    least = std::min(least, simulate_sections({gear1.toothing(), z}, {gear2.toothing(), z},
                                              train.centre_distance_mm, turn_rad)
                                .clearance_mm);
  }
  return least;
}

void compare(double checked, double simulated, const char* what, unsigned seed,
             ModifiedComparison& result) {
  const double window = 0.08 - 1e-9;  // module 1
  if (checked > window || simulated > window || simulated < -window) return;
  const double difference = std::abs(checked - simulated);
  // the simulation steps over what is nearest between its heights and positions: it may say more
  result.largest_difference_mm = std::max(result.largest_difference_mm, difference);
  ++result.compared;
  const bool grey = std::abs(checked) < kGreyZone_mm || std::abs(simulated) < kGreyZone_mm;
  if (!grey && (checked < 0.0) != (simulated < 0.0)) ++result.wrong_verdicts;
  if (difference > kGreyZone_mm)
    std::printf("seed %u %s: checked %.3f um, simulated %.3f um\n", seed, what, 1e3 * checked,
                1e3 * simulated);
}

}  // namespace

ModifiedComparison compare_modified(unsigned first, int designs, int heights) {
  ModifiedComparison result;
  for (unsigned seed = first; result.designs < designs; ++seed) {
    std::optional<GearTrain> train;
    try {
      train = random_modified_pair(seed);
    } catch (const std::runtime_error&) {
      continue;  // no such gears
    }
    ++result.designs;
    const TrainMesh& mesh = train->meshes[0];
    const GearPair pair = train->pair(mesh);
    const MeshState state = mesh_states(*train)[0];
    const double centred = simulated(*train, 0.0, heights, state.centred.z_mm);
    result.penetrate += state.centred.clearance_mm < -kGreyZone_mm && centred < -kGreyZone_mm;
    compare(state.centred.clearance_mm, centred, "centred", seed, result);
    if (std::isnan(state.driving.clearance_mm)) continue;
    const ModifiedMesh play = modified_mesh(*train, mesh);
    const double r_b2 = base_radius_mm(pair.gear2());
    // external gears turn against each other to close, a ring with the pinion
    const double sign = pair.internal() ? 1.0 : -1.0;
    const double z = state.driving.z_mm;
    const double driving = std::min(simulated(*train, sign * play.ccw_play_mm / r_b2, heights, z),
                                    simulated(*train, -sign * play.cw_play_mm / r_b2, heights, z));
    compare(state.driving.clearance_mm, driving, "driving", seed, result);
  }
  std::printf("%d modified designs: %d compared, %d penetrate, largest difference %.3f um\n",
              result.designs, result.compared, result.penetrate,
              1e3 * result.largest_difference_mm);
  return result;
}

}  // namespace trueflank::test
