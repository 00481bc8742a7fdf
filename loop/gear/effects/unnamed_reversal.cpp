// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

/// Places are displaced along one axis of the machine (0: x, 1: y), by the sign in which it travels
/// there along the contour: its play. Steps where flanks face along that axis. Told in place of
/// waves, swellings and odd teeth around the gear (whole_forms.cpp), and no candidate of its
/// own.
EffectFamily unnamed_reversal() {
  EffectFamily f = described("unnamed_reversal", {"axis"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double x = normal_part(g, p, 1.0, 0.0), y = normal_part(g, p, 0.0, 1.0);
    c[0] = shape[0] == 0.0 ? (y < 0.0 ? x : -x) : (x < 0.0 ? -y : y);
  };
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.term_keys = {{"axis", TermKey::Kind::kWord, {"x", "y"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const std::string axis = shape[0] == 0.0 ? "x" : "y";
    return "places are displaced along " + axis + " after the direction in which the contour runs" +
           " along " + axis + " there, with steps where flanks face along " + axis +
           " (play of that axis of the machine)";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
