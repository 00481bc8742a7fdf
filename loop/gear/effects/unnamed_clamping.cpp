// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

/// The teeth stand off the axis in the records of one file (0: of any), on one flank or both: the
/// gear was clamped anew for these. Taken up where files of records differ so, told in place of
/// what is the same in all numbers (part/clampings/clampings.cpp), and no candidate of its own.
EffectFamily unnamed_clamping() {
  EffectFamily f = described("unnamed_clamping", {"file"});
  f.columns = [](const EffectShape&) { return 2; };
  f.parameters = {"cos_um", "sin_um"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const int file = static_cast<int>(shape[0]);
    two_directions(g, p, file == 0 || p.file == file ? 1.0 : 0.0, c);
  };
  f.of_one_file = true;
  f.faces_a_direction = true;
  f.term_keys = {{"file"}};
  f.words = [](const ToldForm& told) {
    const double direction = told.direction_rad();
    return "the teeth stand off the axis" +
           (std::isnan(direction) ? std::string() : " " + towards(deg_from_rad(direction))) +
           (told.shape[0] == 0.0
                ? " where these flanks were measured: they were in a clamping of their own"
                : " in the records of this file: the gear was clamped anew for it");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
