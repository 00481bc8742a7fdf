// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily elephant_foot() {
  EffectFamily f;
  f.id = "elephant_foot";
  f.description = "the first layers bulge out";
  f.cause = "first layers pressed against the plate or overheated";
  f.correction = "first layer height and temperature, elephant foot compensation; draw in the foot";
  f.parameters = {"amount_um"};
  f.shape_names = {"height_mm"};
  f.shape_is_continuous = true;
  f.only_positive = true;
  f.shapes = [](const FlankGeometry& g) {
    return heights(g, 0.1, std::max(0.3, 0.3 * g.face_width_mm()), 8, true);
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? std::exp(-std::max(0.0, p.z_mm) / shape[0]) : 0.0;
  };
  f.shape_limits = [](const FlankGeometry& g, std::size_t) { return height_limits(g); };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.told_from = {{"crowning", "sections at several heights near the lower face"}};
  return f;
}

}  // namespace trueflank::loop::gear_effects
