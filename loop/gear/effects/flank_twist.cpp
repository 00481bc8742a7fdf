// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily flank_twist() {
  auto f = on_flanks([](const FlankGeometry&, double u, double v, int) { return u * v; });
  f.id = "flank_twist";
  f.description = "the profile slope changes over the face (bias)";
  f.form_word = "twist_of_flank";
  f.form_told = {"the flanks are twisted: more material at the tip's upper and the root's lower corner",
                 "the flanks are twisted: more material at the tip's lower and the root's upper corner"};
  f.causes = {{kGearMachines, "crowning of a helical gear by radial motion, diagonal grinding"},
              {kInMould, "twist of the cavity"},
              {kPrinting | kContourCutting, "warping"}};
  f.correction = "dress twist-free or change the shift strategy";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  f.preference = 1;
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_profile = true, .along_face = true, .crossed = true};
  };
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    return "The flanks are twisted by " + um(figure(found, "amount_um")) + on_which_flanks(found) +
           ": the profile leans one way below and the other way above";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
