// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

int most_ghost_order(const FlankGeometry& geometry) {
  constexpr int kEachTooth = 3,
                kMost = 400;  // above the second there are more candidates than data
  return std::min(kEachTooth * geometry.teeth(), kMost);
}

double lowest_order_with(double waves, const FlankGeometry& geometry) {
  const double turned =
      (geometry.tip_form_roll_mm() - geometry.root_form_roll_mm()) / geometry.base_radius_mm();
  return std::ceil(waves * kTwoPi / std::abs(turned));
}

namespace {

/// The rotation at which the tool met a place; backwards: as if the teeth were counted so.
double rotation_rad(const FlankGeometry& g, const Place& p, bool backwards) {
  const double along = g.sense() * p.side * p.roll_mm / g.base_radius_mm();
  return g.centre_rad(p.tooth) + g.twist_rad(p.z_mm) + (backwards ? along : -along);
}

void set_columns(EffectFamily& f, bool backwards) {
  f.evaluate = [backwards](const FlankGeometry& g, const Place& p, const EffectShape& shape,
                           double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double angle = shape[0] * rotation_rad(g, p, backwards);  // one argument: one call for both
    c[0] = std::cos(angle);
    c[1] = std::sin(angle);
  };
  f.evaluate_together = [backwards](const FlankGeometry& g, const Place& p,
                                    std::span<const Effect> effects, double* c) {
    std::fill_n(c, 2 * effects.size(), 0.0);
    if (p.surface != Surface::kFlank) return;
    WavesOf waves(rotation_rad(g, p, backwards));
    for (const Effect& effect : effects) {
      const auto [cosine, sine] = waves.of(effect.shape[0]);
      *c++ = cosine;
      *c++ = sine;
    }
  };
}

}  // namespace

EffectFamily ghost_order() {
  EffectFamily f;
  f.id = "ghost_order";
  f.description = "a wave in straight lines over the flanks, of an order that is the machine's";
  f.form_word = "wave_over_rotation";
  f.causes = {{kGearMachines, "worm wheel of the machine, grinding worm, dresser drive"},
              {kInMould, "the machine that cut the cavity"}};
  f.correction = "look at the drive of the machine; geometry follows only where the phase repeats";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.preference = 1;
  f.shapes = [](const FlankGeometry& g) {
    // Once or twice per turn a wave is eccentricity or a stretch; higher ones than these are finer
    // than the patches and found in the traces themselves (local/rotation_waves.h).
    return whole_numbers(3, most_ghost_order(g));
  };
  set_columns(f, false);
  f.is_fine = [](const FlankGeometry& g, const EffectShape& shape) {
    return shape[0] > 2.0 * g.teeth();
  };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    constexpr double kNear = 24.0;
    // A wave over the profile does not become a slope of it.
    double first = 3.0;
    for (const double waves : {0.5, 1.0})
      if (shape[0] >= lowest_order_with(waves, g)) first = lowest_order_with(waves, g);
    // A shape from the traces, above the candidates, stays among its like.
    const double most = shape[0] > most_ghost_order(g) ? shape[0] + kNear : most_ghost_order(g);
    for (double order = std::max(first, shape[0] - kNear);
         order <= std::min(most, shape[0] + kNear); order += 1.0)
      if (order != shape[0]) shapes.push_back({order});
    return shapes;
  };
  f.order = first_value;
  f.doubt_share = 0.05;
  f.doubted_by_any_order = true;
  f.tells_order_along_profile = true;
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.along_profile = true}; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double order = figure(found, "order");
    const bool once_a_tooth = std::fmod(order, g.teeth()) == 0.0;
    return "A wave of " + um(figure(found, "amplitude_um")) + " lies over the " +
           (found.flank == "both" ? "" : found.flank + " ") + "flanks, " + times_per_turn(order) +
           ": " +
           (once_a_tooth ? "it is the same on every tooth, so it may be the tool's form or runout "
                           "as well as the machine's"
                         : "the gear whines at that order");
  };
  return f;
}

/// The same in data that count the teeth, or name the flanks, from the other face: the lines of the
/// wave run the other way. Scans have neither numbers nor names.
EffectFamily ghost_order_counted_backwards() {
  EffectFamily f = ghost_order();
  f.remark = {"its lines run as if the teeth of these data were counted clockwise, or the flanks "
              "named from the other face",
              f.form_word};
  f.form_word = "wave_over_rotation_backwards";
  f.correctable = Correctable::kNoCause;
  f.of_traces_only = true;
  set_columns(f, true);
  return f;
}

}  // namespace trueflank::loop::gear_effects
