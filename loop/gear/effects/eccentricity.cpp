// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily eccentricity() {
  EffectFamily f;
  f.id = "eccentricity";
  f.description = "the teeth stand off the axis";
  f.causes = {
      {kMachining, "bore and teeth were made in different clampings, or the part sat off centre"},
      {kPrinting | kWireCutting | kBeamCutting,
       "the bore was reamed or drilled off the centre of the teeth, or pressed onto its seat "
       "askew"},
      {kInMould, "the core of the bore stands off the centre of the mould"}};
  f.correction =
      "true the part on its pitch circle or re-bore; move the toothing against the bore "
      "where it repeats";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    two_directions(g, p, 1.0, c);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3&, const EffectShape&,
                         const double* b) -> Point3 {
    return {1e-3 * b[0], 1e-3 * b[1], 0.0};
  };
  f.told_from = {{"pitch_wave", "the index of the other flank too, or the radial runout"}};
  f.causes_told_by =
      "of the toothing against the bore, or of the mounting; measure again in "
      "another clamping";
  f.shown_by =
      "these data cannot show eccentricity; measure in the datum's frame (--aligned), the bore in "
      "the "
      "same scan, or the index of both flanks";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double e = figure(found, "amplitude_um");
    return "The teeth stand " + um(e) + " off the bore " + towards(figure(found, "phase_deg")) + ": runout " + um(2.0 * e);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
