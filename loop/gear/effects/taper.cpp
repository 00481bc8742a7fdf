// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily taper() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return 0.5 * v; });
  f.id = "taper";
  f.description = "the teeth grow thicker with height where positive";
  f.cause = "draft, cooling of layers, deflection of the machine, infeed over the stroke";
  f.correction = "tailstock or axis slope, draft of the mould; taper the model the other way";
  f.parameters = {"slope_um"};
  f.told_from = {{"elephant_foot", "helix traces or sections at several heights near the lower face"}};
  return f;
}

}  // namespace trueflank::loop::gear_effects
