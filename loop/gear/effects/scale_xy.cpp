// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily scale_xy() {
  EffectFamily f;
  f.id = "scale_xy";
  f.description = "one axis in the plane is longer than the other";
  f.form_word = "unequal_axes";
  f.causes = {{kPrinting | kContourCutting, "steps per millimetre of x and y differ"},
              {kPrinting | kInMould,
               "the part was cooled or squeezed one-sidedly, or shrinks along its flow"}};
  f.correction = "calibrate the axes; stretch the model the other way";
  f.parameters = {"percent", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.phase_divisor = 2.0;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    const PlanePoint x = point_of(p);
    // The larger axis takes half of the difference, the smaller gives half.
    c[0] = p.surface == Surface::kFlank ? 5.0 * normal_part(g, p, x.x, -x.y) : 0.0;
    c[1] = p.surface == Surface::kFlank ? 5.0 * normal_part(g, p, x.y, x.x) : 0.0;
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const EffectShape&,
                         const double* b) -> Point3 {
    const double c = 0.5 * 1e-2 * b[0], s = 0.5 * 1e-2 * b[1];
    return {c * p[0] + s * p[1], s * p[0] - c * p[1], 0.0};
  };
  f.order = [](const EffectShape&) { return 2.0; };
  f.doubt_share = 0.3;
  f.told_from = {{"skew", "an orientation mark, or two parts made at 0 and 45 degrees"},
                 {"lobing", "both flanks: the tangential part; a circular bore"},
                 {"pitch_wave", "the index of both flanks"}};
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double percent = figure(found, "percent");
    return printed("The part is %.3g %% longer ", std::abs(percent)) + towards(figure(found, "phase_deg")) +
           " than across: out of round by " + um(10.0 * percent * g.reference_radius_mm());
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
