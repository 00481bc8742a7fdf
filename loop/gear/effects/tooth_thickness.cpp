// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily tooth_thickness() {
  auto f = on_flanks([](const FlankGeometry& g, double, double, int) {
    return 0.5 * std::cos(g.pressure_angle_rad()) * std::cos(g.base_helix_rad());
  });
  f.id = "tooth_thickness";
  f.description = "the teeth are too thick or too thin, the tips as designed";
  f.form_word = "thickness";
  f.form_told = {"the teeth are too thick, the tips as designed",
                 "the teeth are too thin, the tips as designed"};
  f.causes = {{kMachining, "infeed of the tool (profile shift error), tool thickness"},
              {kPrinting | kContourCutting | kInMould,
               "profile shift or thinning of the model, width of line or kerf"}};
  f.correction = "correct the infeed; profile shift or thinning of the model";
  f.corrections = {{kMachining, "correct the infeed"},
                   {kPrinting, "correct the width of line or the contour (XY) compensation"},
                   {kWireCutting | kBeamCutting, "correct the kerf"},
                   {kInMould, "correct the cavity"}};
  f.parameters = {"amount_um"};
  f.shows_in_sizes = true;
  // both flanks of the tooth, from the reference circle to the flank's normal
  f.walls_outside_um = [](const FlankGeometry& g, const double* b) {
    return 0.5 * b[0] * g.base_radius_mm() / g.reference_radius_mm();
  };
  f.shown_by = "these data cannot show the tooth thickness; measure span or over pins";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double amount = figure(found, "amount_um");
    return "The teeth are " + um(amount) + (amount > 0.0 ? " too thick: backlash is missing by as much"
                                                         : " too thin: backlash grows by as much");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
