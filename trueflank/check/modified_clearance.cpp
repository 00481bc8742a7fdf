// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/modified_clearance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/base/tolerance.h"
#include "trueflank/geometry/section_profile.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

constexpr double kNoPlay_mm = 1e-9;

const TrainGear& gear_of(const GearTrain& train, int index) {
  return train.gears[static_cast<std::size_t>(index)];
}

/// What both flanks of both gears have at a height, from root to tip.
std::vector<double> material(const GearTrain& train, const TrainMesh& mesh, double z_mm) {
  constexpr int kPlaces = 24;
  std::vector<double> all;
  for (int index : {mesh.gear1, mesh.gear2}) {
    const TrainGear& gear = gear_of(train, index);
    if (gear.deviation.empty()) continue;
    const double root = gear.profile.root_form_roll_length_mm();
    const double tip = gear.profile.tip_form_roll_length_mm();
    for (Flank flank : {Flank::kLeft, Flank::kRight})
      for (int i = 0; i <= kPlaces; ++i)
        all.push_back(gear.deviation.deviation_mm(0, flank, root + (tip - root) * i / kPlaces,
                                                  z_mm - gear.z_lower_mm));
  }
  return all;
}

/// Heights with nowhere less material than at another one: a clearance only falls with material.
std::vector<double> decisive_heights(const GearTrain& train, const TrainMesh& mesh) {
  const std::vector<double> heights = section_heights_mm(train, mesh);
  std::vector<std::vector<double>> fields;
  for (double z : heights) fields.push_back(material(train, mesh, z));
  const auto outdone_by = [&](std::size_t i, std::size_t j) {
    bool equal = true;
    for (std::size_t k = 0; k < fields[i].size(); ++k) {
      if (fields[i][k] > fields[j][k] + 1e-12) return false;
      equal = equal && std::abs(fields[i][k] - fields[j][k]) <= 1e-12;
    }
    return !equal || j < i;
  };
  std::vector<double> kept;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    bool outdone = false;
    for (std::size_t j = 0; j < heights.size() && !outdone; ++j)
      outdone = j != i && outdone_by(i, j);
    if (!outdone) kept.push_back(heights[i]);
  }
  return kept;
}

void keep_lower(MeshClearance& lowest, MeshClearance other, double z_mm) {
  other.z_mm = z_mm;
  if (std::isnan(lowest.clearance_mm) || other.clearance_mm < lowest.clearance_mm)
    lowest = std::move(other);
}

}  // namespace

bool is_modified(const GearTrain& train, const TrainMesh& mesh) {
  return !gear_of(train, mesh.gear1).deviation.empty() ||
         !gear_of(train, mesh.gear2).deviation.empty();
}

MeshState modified_state(const GearTrain& train, const TrainMesh& mesh) {
  const TrainGear &gear1 = gear_of(train, mesh.gear1), &gear2 = gear_of(train, mesh.gear2);
  const ModifiedMesh play = modified_mesh(train, mesh);
  const double closing = play.ccw_play_mm / base_radius_mm(gear2.profile.gear());
  MeshState state;
  for (double z : decisive_heights(train, mesh)) {
    const ToothSection section1 = section_profile(gear1.toothing(), z - gear1.z_lower_mm);
    const ToothSection section2 = section_profile(gear2.toothing(), z - gear2.z_lower_mm);
    const GearPair pair{&section1.profile, &section2.profile, train.centre_distance_mm};
    // the sections are symmetric: to which side they stand off the centre does not matter
    const double off_centre = closing_turn_rad(train, mesh, z);
    const bool centred =
        std::abs(off_centre) * base_radius_mm(gear2.profile.gear()) < 1e-12;
    keep_lower(state.centred, mesh_clearance(pair, centred ? 0.0 : std::abs(off_centre)), z);
    if (play.ccw_play_mm > kNoPlay_mm)
      keep_lower(state.driving, closed_clearance(pair, closing + off_centre), z);
  }
  return state;
}

}  // namespace trueflank
