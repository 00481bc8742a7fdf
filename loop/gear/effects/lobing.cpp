// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily lobing() {
  EffectFamily f;
  f.id = "lobing";
  f.description = "the gear is out of round";
  f.form_word = "wave_of_radius";
  f.causes = {{kMachining, "jaws of the chuck"},
              {kInMould, "gates of the mould"},
              {kPrinting, "corners of infill or supports, backlash of the axes"},
              {kWireCutting | kBeamCutting, "stresses of the blank set free"},
              {kAnyMaking, "press fit of a ring, ovality"}};
  f.correction = "clamp softer or move the gates; a radial wave in the model where it repeats";
  f.corrections = {{kMachining, "clamp softer"},
                   {kInMould, "move the gates"},
                   {kPrinting, "look at infill, supports and backlash of the axes"},
                   {kWireCutting | kBeamCutting, "set the blank's stresses free before cutting"}};
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.shapes = [](const FlankGeometry& g) {
    // (what comes again every two or three teeth is a pattern of teeth, as of the starts of a hob)
    constexpr int kMost = 16, kTeethOfLobe = 3;
    const int most = std::max((g.teeth() - 1) / kTeethOfLobe, std::min(2, (g.teeth() - 1) / 2));
    return whole_numbers(2, std::min(kMost, most));
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double radial = normal_part(g, p, p.polar_direction[0], p.polar_direction[1]);
    const double angle = shape[0] * p.polar_rad;  // one argument: one call for both
    c[0] = radial * std::cos(angle);
    c[1] = radial * std::sin(angle);
  };
  f.evaluate_together = [](const FlankGeometry& g, const Place& p, std::span<const Effect> effects,
                           double* c) {
    const bool on_flank = p.surface == Surface::kFlank;
    const double radial =
        on_flank ? normal_part(g, p, p.polar_direction[0], p.polar_direction[1]) : 0.0;
    WavesOf waves(p.polar_rad);
    for (const Effect& effect : effects) {
      const auto [cosine, sine] = waves.of(effect.shape[0]);
      *c++ = radial * cosine;
      *c++ = radial * sine;
    }
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const EffectShape& shape,
                         const double* b) -> Point3 {
    const double polar = std::atan2(p[1], p[0]);
    const double radial =
        1e-3 * (b[0] * std::cos(shape[0] * polar) + b[1] * std::sin(shape[0] * polar));
    return {radial * std::cos(polar), radial * std::sin(polar), 0.0};
  };
  f.order = first_value;
  f.doubt_share = 0.05;
  f.told_from = {{"pitch_wave", "both flanks, or the radial runout"}};
  f.causes_told_by =
      "chuck jaws, gates and press fits look alike; measure before and after unclamping, "
      "compare the phase with jaws and gates";
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double a = figure(found, "amplitude_um");
    return "The gear is out of round by " + um(2.0 * a) + ", " + times_per_turn(figure(found, "order")) +
           ": backlash changes as often";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
