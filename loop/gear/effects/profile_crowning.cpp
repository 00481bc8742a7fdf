// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily profile_crowning() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return -u * u; });
  f.id = "profile_crowning";
  f.description = "material is missing towards root and tip";
  f.cause = "form of tool or dresser, elastic tool, wear";
  f.correction = "dress or design the profile accordingly";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  return f;
}

}  // namespace trueflank::loop::gear_effects
