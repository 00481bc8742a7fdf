// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {

/// A deviation along the normal that hangs on the direction which a flank faces, in so many waves a
/// turn of it: once a turn it would be a shift, an eccentricity. Told in place of waves around the
/// gear, which follow it (fields.cpp), and no candidate of its own.
EffectFamily unnamed_facing() {
  EffectFamily f = described("unnamed_facing", {"waves_per_turn"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    const bool flank = p.surface == Surface::kFlank;
    const std::complex<double> faced(p.normal_direction[0], p.normal_direction[1]);
    std::complex<double> wave = 1.0;
    for (int k = 0; k < static_cast<int>(shape[0]); ++k) wave *= faced;
    c[0] = flank ? wave.real() : 0.0;
    c[1] = flank ? wave.imag() : 0.0;
  };
  f.faces_a_direction = true;
  f.term_keys = {{"waves_per_turn"}};
  f.words = [](const ToldForm& told) {
    return "the flanks stand out and lie back by the direction that they face, " +
           times_per_turn(told.shape[0]) + first_at(told.direction_rad(), told.shape[0]) +
           ", as from a kerf, a light, a probe or the play of an axis that differs by direction";
  };
  return f;
}

/// Flanks that face one direction, the others not at all; by the cosine to it or, `power` 2, its
/// square.
EffectFamily unnamed_facing_one_side() {
  EffectFamily f = described("unnamed_facing_one_side", {"towards_deg", "power"});
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? faces(p, shape[0], shape[1]) : 0.0;
  };
  f.faces_a_direction = true;
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) { return facings_beside(shape); };
  f.term_keys = {number("towards_deg"), {"power"}};
  f.words = [](const ToldForm& told) {
    return "flanks that face " + gear_effects::towards(told.shape[0]) + " " + stand(told.sign()) +
           ", those that face away do not, as from a jet, a beam or dirt of one side";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
