// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily crowning() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return -v * v; });
  f.id = "crowning";
  f.description = "material is missing towards both ends of the face";
  f.form_word = "bow_over_face";
  f.form_told = {"material is missing towards both ends of the face",
                 "too much material stands towards both ends of the face"};
  f.causes = {{kGearMachines, "crowning motion, deflection"},
              {kPrinting, "edges rounded or cooled faster than the middle"},
              {kContourCutting, "barrelling of the wire, deflection of the cutter"},
              {kInMould, "shrinkage held back at the faces"},
              {kAnyMaking, "ends of the teeth polished or worn"}};
  f.correction = "set the crowning; design it, or take it out of the model";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double amount = figure(found, "amount_um");
    return (amount > 0.0 ? "The flanks are crowned by " : "The flanks are hollow by ") + um(amount) +
           on_which_flanks(found) + " over the face: they carry " + (amount > 0.0 ? "in the middle" : "at both ends");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
