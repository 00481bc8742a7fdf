// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily helix_error() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int side) {
    return 0.5 * v * side;
  });
  f.id = "helix_error";
  f.description = "the section turns with height: counter-clockwise where positive";
  f.cause = "lead of the machine, differential, twist of the print";
  f.correction = "lead correction; twist the model the other way";
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  f.told_from = {{"taper", "helix traces of both flanks"}};
  f.causes_told_by = "lead of the machine and twist of a print look alike; the process tells, "
                     "or a test of the spindle";
  return f;
}

}  // namespace trueflank::loop::gear_effects
