// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/design_change.h"

#include <algorithm>
#include <cmath>

namespace trueflank {
namespace {

/// What design files take; backlash: at most a module.
constexpr double kLeastAddendum = 0.05;


/// Centre distances and leading shifts as people write them.
double written(double value) { return std::round(value * 1e4) / 1e4; }

/// A leading shift that stays, or was solved: its mates are solved to it, and nobody reads 16 digits.
double kept(double shift) { return std::round(shift * 1e6) / 1e6; }

/// What other teeth ask of the centre distance: that of the first mesh without shifts, less before.
double reference_change_mm(const GearTrain& train, const std::vector<int>& teeth) {
  if (teeth.empty()) return 0.0;
  const TrainMesh& mesh = train.meshes.front();
  MeshTeeth before = mesh_teeth(train.pair(mesh)), after = before;
  after.teeth1 += teeth[static_cast<std::size_t>(mesh.gear1)];
  after.teeth2 += teeth[static_cast<std::size_t>(mesh.gear2)];
  return reference_centre_distance_mm(after) - reference_centre_distance_mm(before);
}

}  // namespace

bool DesignChange::moves_shifts() const {
  return centre_distance != 0.0 || !teeth.empty() ||
         std::any_of(shift_of_layer.begin(), shift_of_layer.end(), [](const auto& s) { return s.second != 0.0; });
}

double DesignChange::cost() const {
  double sum = 1.2 * std::abs(centre_distance) + 2.0 * std::abs(backlash) + 1.5 * std::abs(root_radius) +
               1.5 * std::abs(addendum) + (planets != 0 ? 2.0 * std::abs(planets) : 0.0);
  for (const auto& [layer, shift] : shift_of_layer) sum += std::abs(shift);
  int moved = 0;
  for (const int change : teeth) moved += std::abs(change);
  return sum + (moved > 0 ? 2.0 + 0.3 * moved : 0.0);
}

std::size_t leading_gear(const GearTrain& train, int layer) {
  std::vector<int> meshes(train.gears.size(), 0);
  for (const TrainMesh& mesh : train.meshes) {
    ++meshes[static_cast<std::size_t>(mesh.gear1)];
    ++meshes[static_cast<std::size_t>(mesh.gear2)];
  }
  std::size_t best = train.gears.size();
  for (std::size_t i = 0; i < train.gears.size(); ++i)
    if (train.gears[i].layer == layer && meshes[i] > 0 && (best == train.gears.size() || meshes[i] > meshes[best]))
      best = i;
  return best;
}

std::vector<int> meshing_layers(const GearTrain& train) {
  std::vector<int> layers;
  for (const TrainMesh& mesh : train.meshes) {
    const int layer = train.gears[static_cast<std::size_t>(mesh.gear1)].layer;
    if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
  return layers;
}

GearboxDesign changed_design(const GearTrain& train, const DesignChange& change, bool fits) {
  GearboxDesign design = train.design;
  const double m = design.module_mm;
  design.tips = TipCircles::kClear;
  design.planets += change.planets;
  if (change.layer_gap_mm != 0.0) design.layer_gap_mm = written(design.layer_gap_mm + change.layer_gap_mm);
  if (change.backlash != 0.0) design.backlash_mm = std::min(written(design.backlash_mm + change.backlash * m), m);
  if (change.root_radius != 0.0) design.rack.root_radius = written(std::max(0.0, design.rack.root_radius + change.root_radius));
  if (change.addendum != 0.0) design.rack.addendum = written(std::max(kLeastAddendum, design.rack.addendum + change.addendum));
  for (std::size_t i = 0; i < change.teeth.size(); ++i) design.gears[i].teeth += change.teeth[i];
  for (const auto& [i, diameter] : change.tip_diameter_mm) design.gears[i].tip_diameter_mm = diameter;
  if (!change.moves_shifts() && fits) return design;

  const double a = train.centre_distance_mm + change.centre_distance * m + reference_change_mm(train, change.teeth);
  const bool new_distance = change.centre_distance != 0.0 || !change.teeth.empty();
  if (new_distance) design.centre_distance_mm = written(a);
  if (!design.centre_distance_mm) design.centre_distance_mm = kept(a);
  for (GearDesign& gear : design.gears) gear.shift.reset();
  for (const int layer : meshing_layers(train)) {
    const std::size_t lead = leading_gear(train, layer);
    const auto moved = change.shift_of_layer.find(layer);
    const double by = moved == change.shift_of_layer.end() ? 0.0 : moved->second;
    // a shift that was solved for a distance far from the new one says nothing there
    const bool solved_elsewhere =
        std::abs(change.centre_distance) > kFarCentreDistance && !train.design.gears[lead].shift;
    const double from = solved_elsewhere ? 0.0 : train.gears[lead].shift;
    design.gears[lead].shift = by == 0.0 ? kept(from) : written(from + by);
  }
  return design;
}

}  // namespace trueflank
