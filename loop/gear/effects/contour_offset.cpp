// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily contour_offset() {
  EffectFamily f;
  f.id = "contour_offset";
  f.description = "every wall stands too far out or in";
  f.causes = {{kPrinting, "width of the extruded line, bleeding of light or heat"},
              {kContourCutting, "kerf, spark gap, cutter compensation"},
              {kInMould, "the cavity was made too wide or too narrow"}};
  f.correction = "set the contour (XY) compensation or the kerf; offset all walls the other way";
  f.parameters = {"offset_um"};
  f.evaluate = [](const FlankGeometry&, const Place&, const EffectShape&, double* c) {
    c[0] = 1.0;
  };
  f.shows_in_sizes = true;
  f.moves_circles = true;
  f.walls_outside_um = [](const FlankGeometry&, const double* b) { return b[0]; };
  f.told_from = {{"tooth_thickness", "tip, root or bore diameter: an offset moves all walls"}};
  f.shown_by = "these data cannot show the tooth thickness; measure span or over pins";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double offset = figure(found, "offset_um");
    return "Every wall stands " + um(offset) + (offset > 0.0 ? " too far out: the teeth are thicker"
                                                             : " too far in: the teeth are thinner") +
           " and the tip diameter is off by " + um(2.0 * offset);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
