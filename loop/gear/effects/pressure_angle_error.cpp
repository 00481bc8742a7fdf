// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily pressure_angle_error() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return 0.5 * u; });
  f.id = "pressure_angle_error";
  f.description = "the profile leans: more material towards the tip where positive";
  f.form_word = "slope_over_profile";
  f.form_told = {"the profile leans: more material towards the tip",
                 "the profile leans: less material towards the tip"};
  f.causes = {{kGearMachines,
               "pressure angle of tool or dresser, base circle (both flanks alike); tool tilted or "
               "off centre (flanks opposite)"},
              {kPrinting | kContourCutting, "scale or line width that changes towards the tip"},
              {kInMould, "the cavity was not made for the shrinkage of the teeth"}};
  f.correction = "correct the angle of tool or dresser; pressure angle of the model";
  f.corrections = {{kGearMachines, "correct the angle of tool or dresser"},
                   {kPrinting | kContourCutting, "correct scale and width of line or kerf"},
                   {kInMould, "make the cavity for the shrinkage of the teeth"}};
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double slope = figure(found, "slope_um");
    return "The profiles lean by " + um(slope) + on_which_flanks(found) +
           (slope > 0.0 ? ", more material at the tip: the teeth meet tip first"
                        : ", less material at the tip: the teeth carry near the root");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
