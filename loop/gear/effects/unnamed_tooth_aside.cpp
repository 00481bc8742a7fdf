// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {

/// A pitch error of one tooth: more material on one flank, as much less on the other.
EffectFamily unnamed_tooth_aside() {
  EffectFamily f;
  f.id = "unnamed_tooth_aside";
  f.description = "one tooth stands aside";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth", "aside"};
  f.named = false;
  f.term_keys = {{"tooth"}, {"aside"}};
  f.local = true;
  f.preference = 3;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) {
    constexpr double kCounterClockwise = 1.0;
    std::vector<EffectShape> shapes = whole_numbers(1, g.teeth());
    for (EffectShape& shape : shapes) shape.push_back(kCounterClockwise);
    return shapes;
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && p.tooth == static_cast<int>(shape[0]) ? shape[1] * p.side
                                                                                 : 0.0;
  };
  f.words = [](const ToldForm& told) {
    const int sign = told.sign() * (told.shape[1] < 0.0 ? -1 : 1);
    return "tooth " + std::to_string(static_cast<int>(told.shape[0])) + " stands aside, " +
           (sign == 0 ? "ahead on one flank and back on the other" : turned(sign));
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
