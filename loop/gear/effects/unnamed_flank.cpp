// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {

EffectFamily unnamed_flank() {
  EffectFamily f;
  f.id = "unnamed_flank";
  f.description = "one flank of one tooth stands out";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth"};
  f.named = false;
  f.term_keys = {{"tooth"}};
  f.flank_only = true;
  f.local = true;
  f.preference = 4;
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
  f.words = [](const ToldForm& told) {
    return "the " + std::string(told.flank == FlankChoice::kLeft ? "left" : "right") +
           " flank of tooth " + std::to_string(static_cast<int>(told.shape[0])) + " " +
           stands(told.sign());
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
