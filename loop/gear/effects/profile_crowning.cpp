// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily profile_crowning() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return -u * u; });
  f.id = "profile_crowning";
  f.description = "material is missing towards root and tip";
  f.form_word = "bow_over_profile";
  f.form_told = {"material is missing towards root and tip",
                 "too much material stands towards root and tip"};
  f.causes = {{kGearMachines, "form of tool or dresser, elastic tool"},
              {kPrinting | kContourCutting, "rounding of the contour towards root and tip"},
              {kInMould, "sink marks, form of the cavity"},
              {kAnyMaking, "wear"}};
  f.correction = "dress or design the profile accordingly";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double amount = figure(found, "amount_um");
    return (amount > 0.0 ? "The profiles are rounded by " : "The profiles are hollow by ") + um(amount) +
           on_which_flanks(found) + ": contact " + (amount > 0.0 ? "gathers at mid height" : "is at tip and root");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
