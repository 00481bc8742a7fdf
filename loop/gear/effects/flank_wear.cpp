// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily flank_wear() {
  EffectFamily f;
  f.id = "flank_wear";
  f.description = "a hollow across the flank, around a diameter";
  f.form_word = "hollow_over_profile";
  f.form_told = {"a hollow across the flanks",
                 "a ridge across the flanks"};
  f.causes = {{kAnyMaking, "sliding under load on the loaded flank"}};
  f.correction = "look at lubrication, material and load; nothing the geometry of a new part should cancel";
  f.parameters = {"depth_um"};
  f.shape_names = {"centre_diameter_mm", "width_mm"};
  f.shape_is_continuous = true;
  f.one_flank_too = true;
  f.preference = 1;
  f.correctable = Correctable::kNoCause;
  f.only_positive = true;
  f.shapes = [](const FlankGeometry& g) {
    std::vector<EffectShape> shapes;
    const double length = g.tip_form_roll_mm() - g.root_form_roll_mm();
    for (const double part : {0.15, 0.3, 0.45, 0.6, 0.75, 0.9})
      for (const double width : {0.1, 0.2})
        shapes.push_back({diameter_at_roll_share(g, part), width * std::abs(length)});
    return shapes;
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double t = (p.roll_mm - g.roll_at_radius_mm(0.5 * shape[0])) / shape[1];
    c[0] = -std::exp(-t * t);
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.along_profile = true}; };
  f.shape_limits = [](const FlankGeometry& g, std::size_t k) {
    if (k == 0) return diameter_limits(g);
    const double length = std::abs(g.tip_form_roll_mm() - g.root_form_roll_mm());
    return std::pair(0.02 * length, length);
  };
  f.told_from = {{"profile_crowning", "profile traces over the whole flank, and the unworn flank"}};
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    return "A hollow of " + um(figure(found, "depth_um")) + " runs along the flanks" + on_which_flanks(found) +
           " at diameter " + printed("%.5g mm", figure(found, "centre_diameter_mm")) + ": they are worn there";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
