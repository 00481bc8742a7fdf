// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily taper() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return 0.5 * v; });
  f.id = "taper";
  f.description = "the teeth grow thicker with height where positive";
  f.form_word = "taper_over_face";
  f.form_told = {"the teeth grow thicker with height",
                 "the teeth grow thinner with height"};
  f.causes = {
      {kGearMachines, "tailstock or axis slope, deflection of the machine, infeed over the stroke"},
      {kPrinting, "cooling of the layers"},
      {kContourCutting, "draft of the beam, lag of the wire, deflection of the cutter"},
      {kInMould, "draft"}};
  f.correction = "set tailstock or axis slope, or the draft of the mould; taper the model the other way";
  f.corrections = {{kGearMachines, "set tailstock or axis slope"},
                   {kMilling, "allow for the deflection of the cutter"},
                   {kWireCutting | kBeamCutting, "set the taper compensation of wire or beam"},
                   {kPrinting, "taper the model the other way"},
                   {kInMould, "correct the draft of mould or die"}};
  f.parameters = {"slope_um"};
  f.told_from = {
      {"elephant_foot", "helix traces or sections at several heights near the lower face"}};
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double slope = figure(found, "slope_um");
    return "Each flank stands " + um(slope) + " further out at the " + (slope > 0.0 ? "top" : "bottom") +
           ": the teeth carry at that end";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
