// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily crowning() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return -v * v; });
  f.id = "crowning";
  f.description = "material is missing towards both ends of the face";
  f.cause = "crowning motion, deflection, edges polished or worn";
  f.correction = "crowning setting; design it, or take it out of the model";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  return f;
}

}  // namespace trueflank::loop::gear_effects
