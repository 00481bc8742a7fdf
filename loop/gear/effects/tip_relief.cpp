// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily tip_relief() {
  EffectFamily f;
  f.id = "tip_relief";
  f.description = "material is missing at the tip, from a diameter on";
  f.form_word = "fall_towards_tip";
  f.form_told = {"material is missing at the tip",
                 "too much material stands at the tip"};
  f.causes = {{kGearMachines, "relief by tool or dresser"},
              {kPrinting | kContourCutting, "rounding of the tips"},
              {kInMould, "tips that did not fill"},
              {kAnyMaking, "wear of the tip"}};
  f.correction = "correct the relief of the tool; design it, or take it out of the model";
  f.only_positive = true;
  f.parameters = {"amount_um"};
  f.shape_names = {"start_diameter_mm"};
  f.shape_is_continuous = true;
  f.one_flank_too = true;
  f.shapes = [](const FlankGeometry& g) {
    std::vector<EffectShape> shapes;
    for (const double part : {0.25, 0.4, 0.5, 0.6, 0.7, 0.8, 0.88})
      shapes.push_back({diameter_at_roll_share(g, part)});
    return shapes;
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double start = g.roll_at_radius_mm(0.5 * shape[0]);
    const double past = (p.roll_mm - start) / (g.tip_form_roll_mm() - start);
    if (past > 0.0) c[0] = -past * past;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.along_profile = true}; };
  f.shape_limits = [](const FlankGeometry& g, std::size_t) { return diameter_limits(g); };
  f.told_from = {{"flank_wear", "the unworn (coast) flank"},
                 {"profile_crowning", "profile traces with more points near the tip"},
                 {"pressure_angle_error", "profile traces over the whole flank"}};
  f.causes_told_by = "wear looks like relief; measure the unworn (coast) flank, or a new part";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    return um(figure(found, "amount_um")) + " of material are missing at the tip" + on_which_flanks(found) +
           ", from diameter " + printed("%.5g mm", figure(found, "start_diameter_mm")) +
           " on: contact ends before the tip";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
