// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily pitch_wave() {
  EffectFamily f;
  f.id = "pitch_wave";
  f.description = "the teeth stand ahead and behind in a wave around the gear";
  f.form_word = "wave_of_pitch";
  f.causes = {{kGearMachines, "rotary table, worm of the machine"},
              {kPrinting | kContourCutting, "steps or belt of a drive"},
              {kInMould, "indexing of the cavity"}};
  f.correction = "calibrate the table; turn the teeth of the model the other way";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.shapes = [](const FlankGeometry& g) {
    return whole_numbers(1, std::min(60, (g.teeth() - 1) / 2));
  };
  // A turn by an arc on the reference circle moves the flank by the same turn on the base circle.
  const auto lever = [](const FlankGeometry& g, const Place& p) {
    return p.side * g.base_radius_mm() / g.reference_radius_mm() * g.cos_base_helix();
  };
  f.evaluate = [lever](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double angle = shape[0] * g.centre_rad(p.tooth);  // one argument: one call for both
    c[0] = lever(g, p) * std::cos(angle);
    c[1] = lever(g, p) * std::sin(angle);
  };
  f.evaluate_together = [lever](const FlankGeometry& g, const Place& p,
                                std::span<const Effect> effects, double* c) {
    std::fill_n(c, 2 * effects.size(), 0.0);
    if (p.surface != Surface::kFlank) return;
    WavesOf waves(g.centre_rad(p.tooth));
    for (const Effect& effect : effects) {
      const auto [cosine, sine] = waves.of(effect.shape[0]);
      *c++ = lever(g, p) * cosine;
      *c++ = lever(g, p) * sine;
    }
  };
  f.order = first_value;
  f.doubt_share = 0.05;
  // Once per turn a gear that stands off its axis is what shops meet.
  f.complexity = [](const EffectShape& shape) { return shape[0] == 1.0 ? 1.0 : 0.0; };
  f.causes_told_by =
      "an error of the measuring table looks like one of the gear; measure at two "
      "orientations on the table";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double a = figure(found, "amplitude_um");
    return "The teeth stand up to " + um(a) + " ahead and behind, " + times_per_turn(figure(found, "order")) +
           ": cumulative pitch error " + um(2.0 * a);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
