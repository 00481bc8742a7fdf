// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/modified_clearance.h"

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
    bool outdone = j < i;  // of equal ones the first decides
    for (std::size_t k = 0; k < fields[i].size(); ++k) {
      if (fields[i][k] > fields[j][k] + 1e-12) return false;
      if (fields[i][k] < fields[j][k] - 1e-12) outdone = true;
    }
    return outdone;
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

PairSection mesh_section(const GearTrain& train, const TrainMesh& mesh, double z_mm) {
  const TrainGear &gear1 = gear_of(train, mesh.gear1), &gear2 = gear_of(train, mesh.gear2);
  return {section_profile(gear1.toothing(), z_mm - gear1.z_lower_mm).profile,
          section_profile(gear2.toothing(), z_mm - gear2.z_lower_mm).profile,
          mesh.centre_distance_mm, z_mm};
}

std::vector<PairSection> decisive_sections(const GearTrain& train, const TrainMesh& mesh) {
  if (!is_modified(train, mesh)) {
    const GearPair pair = train.pair(mesh);
    return {{*pair.profile1, *pair.profile2, pair.centre_distance_mm, kNaN}};
  }
  std::vector<PairSection> sections;
  for (double z : decisive_heights(train, mesh)) sections.push_back(mesh_section(train, mesh, z));
  return sections;
}

MeshState modified_state(const GearTrain& train, const TrainMesh& mesh) {
  const ModifiedMesh play = modified_mesh(train, mesh);
  const double r_b2 = base_radius_mm(gear_of(train, mesh.gear2).profile.gear());
  const bool drives = play.ccw_play_mm > kNoPlay_mm && play.cw_play_mm > kNoPlay_mm;
  MeshState state;
  const std::vector<PairSection> sections = decisive_sections(train, mesh);
  for (const PairSection& section : sections) {
    MeshState here = mesh_state(section.pair(), drives ? play.ccw_play_mm / r_b2 : 0.0,
                                drives ? play.cw_play_mm / r_b2 : 0.0);
    keep_lower(state.centred, std::move(here.centred), section.z_mm);
    if (drives) keep_lower(state.driving, std::move(here.driving), section.z_mm);
  }
  for (const PairSection& section : sections)
    if (section.z_mm == state.centred.z_mm) add_exact_verdict(section.pair(), state.centred);
  return state;
}

RadialRemoval modified_removal(const GearTrain& train, const TrainMesh& mesh) {
  const std::vector<PairSection> sections = decisive_sections(train, mesh);
  std::vector<GearPair> pairs;
  for (const PairSection& section : sections) pairs.push_back(section.pair());
  return radial_removal(pairs, twist_over_face_rad(train, mesh));
}

double worst_margin_rad(const GearTrain& train, const TrainMesh& mesh,
                        double (*margin_rad)(const GearPair&)) {
  if (!is_modified(train, mesh)) return margin_rad(train.pair(mesh));
  double worst = kNaN;
  for (const PairSection& section : decisive_sections(train, mesh))
    worst = std::fmin(worst, margin_rad(section.pair()));
  return worst;
}

double modified_clearance_mm(const GearTrain& train, const TrainMesh& mesh) {
  double least = 1e300;
  for (const PairSection& section : decisive_sections(train, mesh))
    least = std::min(least, sweep_clearance_mm(section.pair()));
  return least;
}

}  // namespace trueflank
