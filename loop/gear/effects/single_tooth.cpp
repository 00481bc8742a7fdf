// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily single_tooth() {
  EffectFamily f;
  f.id = "single_tooth";
  f.description = "one tooth stands out on both flanks";
  f.form_word = "height_of_tooth";
  f.form_told = {"one tooth stands out on both flanks",
                 "one tooth lies back on both flanks"};
  f.causes = {{kAnyMaking, "damage, a burr, a chip, a fault of one pass"}};
  f.correction = "inspect or reject the part; nothing to correct in the geometry";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth"};
  f.local = true;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) { return whole_numbers(1, g.teeth()); };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && p.tooth == static_cast<int>(shape[0]) ? 1.0 : 0.0;
  };
  f.evaluate_together = [](const FlankGeometry&, const Place& p, std::span<const Effect> effects,
                           double* c) {
    const double tooth = p.surface == Surface::kFlank ? p.tooth : kNaN;
    for (const Effect& effect : effects) *c++ = effect.shape[0] == tooth ? 1.0 : 0.0;
  };
  f.told_from = {{"pitch_wave", "index of all teeth"}};
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double amount = figure(found, "amount_um");
    return printed("Tooth %.0f ", figure(found, "tooth")) + (amount > 0.0 ? "stands out by " : "lies back by ") + um(amount) +
           " on both flanks: one knock per turn";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
