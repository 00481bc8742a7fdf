// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/farther_designs.h"

#include <algorithm>
#include <cmath>

namespace trueflank {
namespace {

/// As a file writes it.
double rounded(double value) { return std::round(value * 1e3) / 1e3; }

GearboxDesign with_rack_moved(const GearTrain& train, double share) {
  GearboxDesign design = train.design;
  const BasicRack standard;
  const auto move = [share](double& value, double to) { value = rounded(value + share * (to - value)); };
  BasicRack& rack = design.rack;
  double angle_deg = deg_from_rad(rack.pressure_angle_rad);
  move(angle_deg, deg_from_rad(standard.pressure_angle_rad));
  rack.pressure_angle_rad = rad_from_deg(angle_deg);
  move(rack.addendum, standard.addendum);
  move(rack.dedendum, standard.dedendum);
  move(rack.root_radius, standard.root_radius);
  for (GearDesign& gear : design.gears) gear.tip_diameter_mm.reset();
  return design;
}

GearboxDesign with_more_teeth(const GearTrain& train, double factor) {
  GearboxDesign design = train.design;
  for (GearDesign& gear : design.gears) {
    gear.teeth = static_cast<int>(std::lround(gear.teeth * factor));
    gear.tip_diameter_mm.reset();
  }
  if (!design.centre_distance_mm || train.meshes.empty()) return design;
  const TrainMesh& mesh = train.meshes.front();
  const MeshTeeth before = mesh_teeth(train.pair(mesh));
  MeshTeeth after = before;
  after.teeth1 = design.gears[static_cast<std::size_t>(mesh.gear1)].teeth;
  after.teeth2 = design.gears[static_cast<std::size_t>(mesh.gear2)].teeth;
  *design.centre_distance_mm =
      rounded(*design.centre_distance_mm + reference_centre_distance_mm(after) - reference_centre_distance_mm(before));
  return design;
}

}  // namespace

std::vector<GearboxDesign> farther_designs(const GearTrain& train) {
  const bool planetary = train.design.planets > 1;
  if (train.meshes.empty() || !train.assembly.equal_spacing) return {};
  std::vector<GearboxDesign> designs;
  if (train.design.rack.protuberance == 0.0)
    for (const double share : {0.5, 1.0}) designs.push_back(with_rack_moved(train, share));
  if (train.design.machine) return designs;
  const int fewest = std::ranges::min(train.design.gears, {}, &GearDesign::teeth).teeth;
  if (planetary) designs.push_back(with_more_teeth(train, 2.0));
  else
    for (const int teeth : {9, 12, 17})
      if (teeth > fewest) designs.push_back(with_more_teeth(train, static_cast<double>(teeth) / fewest));
  std::erase_if(designs, [&](const GearboxDesign& design) { return design == train.design; });
  return designs;
}

}  // namespace trueflank
