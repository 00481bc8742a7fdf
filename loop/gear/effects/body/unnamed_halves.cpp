// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

/// Two halves of every section, split by a line through the axis, each aside by as much as the
/// other the opposite way, sharp at the split: a mould that is open or shifted there. Flanks, tips
/// and roots; the bore has a core of its own. `towards_deg`: across the split; the columns are
/// along x and y of the half on that side. Told in place of what goes around the gear in pieces
/// (part/body/halves.cpp), and no candidate of its own.
EffectFamily unnamed_halves() {
  EffectFamily f = described("unnamed_halves", {"towards_deg"});
  f.columns = [](const EffectShape&) { return 2; };
  f.parameters = {"cos_um", "sin_um"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface == Surface::kBore || p.surface == Surface::kNone) return;
    const double side = std::cos(p.polar_rad - rad_from_deg(shape[0])) >= 0.0 ? 1.0 : -1.0;
    c[0] = side * normal_part(g, p, 1.0, 0.0);
    c[1] = side * normal_part(g, p, 0.0, 1.0);
  };
  f.faces_a_direction = true;
  f.is_followed_nearly = true;  // (patches of a scan do not end at the split)
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    const double pitch_deg = 360.0 / g.teeth();
    std::vector<EffectShape> shapes;
    for (const double share : {0.5, 0.25, 0.1, 0.03, 0.01})
      for (const double sign : {-1.0, 1.0}) shapes.push_back({shape[0] + sign * share * pitch_deg});
    return shapes;
  };
  f.term_keys = {number("towards_deg")};
  f.words = [](const ToldForm& told) {
    const double across = std::fmod(std::fmod(told.shape[0], 360.0) + 360.0, 360.0);
    std::string text = "two halves of the gear, split across " + towards(across) + " and " +
                       towards(across + 180.0) + ", stand aside";
    const double direction = told.direction_rad();
    if (!std::isnan(direction))
      text += ": the first by " + um(std::hypot(told.amounts[0], told.amounts[1])) + " " +
              towards(deg_from_rad(direction)) + ", the other by as much the opposite way";
    const double off = std::cos(direction - rad_from_deg(across));
    constexpr double kMostly = 0.9;
    return text + (off > kMostly    ? ", as from a mould that does not close at its split"
                   : off < -kMostly ? ", as from a mould whose split was ground or crushed"
                                    : ", as from a mould whose halves are shifted");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
