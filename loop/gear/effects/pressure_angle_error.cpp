// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily pressure_angle_error() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return 0.5 * u; });
  f.id = "pressure_angle_error";
  f.description = "the profile leans: more material towards the tip where positive";
  f.cause = "pressure angle of tool or dresser, base circle (both flanks alike); tool tilted or off "
            "centre (flanks opposite)";
  f.correction = "tool angle or dressing; pressure angle of the model";
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  return f;
}

}  // namespace trueflank::loop::gear_effects
