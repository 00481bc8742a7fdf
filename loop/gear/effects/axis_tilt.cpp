// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily axis_tilt() {
  EffectFamily f;
  f.id = "axis_tilt";
  f.description = "the axis of the teeth leans against the datum axis";
  f.causes = {{kMachining,
               "face runout at clamping, a chip under the part, a table or spindle out of square"},
              {kPrinting, "a plate or axis out of square, warping off the plate"},
              {kWireCutting | kBeamCutting, "the blank or the wire stood out of square"},
              {kInMould, "the core stands askew, or the part bent while it was ejected"}};
  f.correction = "true the clamping face; tilt the toothing against the bore where it repeats";
  f.parameters = {"slope_um_per_mm", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    two_directions(g, p, p.z_mm - 0.5 * g.face_width_mm(), c);
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.displacement_mm = [](const FlankGeometry& g, const Point3& p, const EffectShape&,
                         const double* b) -> Point3 {
    const double z = 1e-3 * (p[2] - 0.5 * g.face_width_mm());
    return {z * b[0], z * b[1], 0.0};
  };
  f.told_from = {{"layer_shift", "sections at more heights"},
                 {"eccentricity", "sections at more heights, or helix traces"}};
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double slope = figure(found, "slope_um_per_mm");
    return "The axis of the teeth leans by " + um(slope) + " per mm " + towards(figure(found, "phase_deg")) +
           ": the helix slopes by up to " + um(slope * g.face_width_mm()) + ", once per turn";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
