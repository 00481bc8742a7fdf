// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily helix_error() {
  auto f =
      on_flanks([](const FlankGeometry&, double, double v, int side) { return 0.5 * v * side; });
  f.id = "helix_error";
  f.description = "the section turns with height: counter-clockwise where positive";
  f.form_word = "lean_over_face";
  f.form_told = {"the section turns counter-clockwise with height",
                 "the section turns clockwise with height"};
  f.causes = {
      {kGearMachines, "lead of the machine, differential"},
      {kPrinting, "twist of the print"},
      {kContourCutting, "wire, beam or cutter out of square to the part, turned about the axis"},
      {kInMould, "lead of the cavity, turning at ejection"}};
  f.correction = "correct the lead; twist the model the other way";
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  f.told_from = {{"taper", "helix traces of both flanks"}};
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double slope = figure(found, "slope_um");
    return "The teeth turn by " + um(slope) + " over the face" + on_which_flanks(found) +
           (slope > 0.0 ? ", counter-clockwise" : ", clockwise") + ": they carry at one end";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
