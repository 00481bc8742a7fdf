// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effect.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {

void Effect::evaluate(const FlankGeometry& geometry, const Place& place, double* values) const {
  const bool on_flank = place.surface == Surface::kFlank;
  if (flank != FlankChoice::kBoth) {
    const Flank wanted = flank == FlankChoice::kLeft ? Flank::kLeft : Flank::kRight;
    if (!on_flank || place.side != flank_side(wanted, geometry.gear().kind)) {
      std::fill_n(values, columns(), 0.0);
      return;
    }
  }
  family->evaluate(geometry, place, shape, values);
}

const EffectFamily* find_family(const std::string& id) {
  for (const EffectFamily& family : effect_library())
    if (family.id == id) return &family;
  return nullptr;
}

std::vector<Effect> candidate_effects(const FlankGeometry& geometry,
                                      const DeclaredFamilies& declared) {
  std::vector<Effect> effects;
  const auto add = [&](const EffectFamily& family) {
    std::vector<std::vector<double>> shapes{{}};
    if (family.shapes) shapes = family.shapes(geometry);
    for (const auto& shape : shapes) {
      if (!family.flank_only) effects.push_back({&family, FlankChoice::kBoth, shape});
      if (!family.one_flank_too && !family.flank_only) continue;
      effects.push_back({&family, FlankChoice::kLeft, shape});
      effects.push_back({&family, FlankChoice::kRight, shape});
    }
  };
  if (declared)
    for (const EffectFamily& family : *declared) add(family);
  for (const EffectFamily& family : effect_library()) add(family);
  return effects;
}

double normal_part(const FlankGeometry& geometry, const Place& place, double ux, double uy) {
  const double nt =
      place.surface == Surface::kFlank ? std::cos(geometry.base_helix_rad()) : 1.0;
  return nt * (ux * std::cos(place.normal_rad) + uy * std::sin(place.normal_rad));
}

}  // namespace trueflank::loop
