// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/effect.h"

// Effects that vary around the gear, and those of one tooth.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;

std::vector<Shape> orders(int from, int to) {
  std::vector<Shape> shapes;
  for (int n = from; n <= to; ++n) shapes.push_back({static_cast<double>(n)});
  return shapes;
}

EffectFamily pitch_wave() {
  EffectFamily f;
  f.id = "pitch_wave";
  f.description = "the teeth stand ahead and behind in a wave around the gear";
  f.cause = "rotary table, worm of the machine, steps or belt of a drive";
  f.correction = "calibrate the table; turn the teeth of the model the other way";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.shapes = [](const FlankGeometry& g) { return orders(1, std::min(60, (g.teeth() - 1) / 2)); };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    // A turn by an arc on the reference circle moves the flank by the same turn on the base circle.
    const double lever = p.side * g.base_radius_mm() / g.reference_radius_mm() *
                         std::cos(g.base_helix_rad());
    c[0] = lever * std::cos(shape[0] * p.centre_rad);
    c[1] = lever * std::sin(shape[0] * p.centre_rad);
  };
  return f;
}

EffectFamily lobing() {
  EffectFamily f;
  f.id = "lobing";
  f.description = "the gear is out of round";
  f.cause = "jaws of the chuck, gates of the mould, press fit of a ring, ovality";
  f.correction = "softer clamping, gate layout; a radial wave in the model where it repeats";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.shapes = [](const FlankGeometry& g) { return orders(2, std::min(16, (g.teeth() - 1) / 2)); };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double radial = normal_part(g, p, std::cos(p.polar_rad), std::sin(p.polar_rad));
    c[0] = radial * std::cos(shape[0] * p.polar_rad);
    c[1] = radial * std::sin(shape[0] * p.polar_rad);
  };
  f.displacement_mm = [](const FlankGeometry&, const std::array<double, 3>& p, const Shape& shape,
                         const double* b) -> std::array<double, 3> {
    const double polar = std::atan2(p[1], p[0]);
    const double radial = 1e-3 * (b[0] * std::cos(shape[0] * polar) + b[1] * std::sin(shape[0] * polar));
    return {radial * std::cos(polar), radial * std::sin(polar), 0.0};
  };
  return f;
}

EffectFamily ghost_order() {
  EffectFamily f;
  f.id = "ghost_order";
  f.description = "a wave in straight lines over the flanks, of an order that is the machine's";
  f.cause = "worm wheel of the machine, grinding worm, dresser drive";
  f.correction = "drive of the machine; geometry follows only where the phase repeats";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.shape_names = {"order"};
  f.form = ParameterForm::kWave;
  f.preference = 1;
  f.shapes = [](const FlankGeometry& g) {
    // Once or twice per turn a wave is eccentricity or a stretch; above a few per tooth it is finer than
    // the patches.
    return orders(3, std::min(3 * g.teeth(), 160));
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double rotation = p.centre_rad + g.twist_rad(p.z_mm) -
                            g.sense() * p.side * p.roll_mm / g.base_radius_mm();
    c[0] = std::cos(shape[0] * rotation);
    c[1] = std::sin(shape[0] * rotation);
  };
  return f;
}

EffectFamily single_tooth() {
  EffectFamily f;
  f.id = "single_tooth";
  f.description = "one tooth stands out on both flanks";
  f.cause = "damage, a burr, a chip, a fault of one pass";
  f.correction = "inspect or reject the part; nothing to correct in the geometry";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth"};
  f.local = true;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) { return orders(1, g.teeth()); };
  f.evaluate = [](const FlankGeometry&, const Place& p, const Shape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && p.tooth == static_cast<int>(shape[0]) ? 1.0 : 0.0;
  };
  return f;
}

}  // namespace

std::vector<EffectFamily> wave_effects() {
  return {pitch_wave(), lobing(), ghost_order(), single_tooth()};
}

}  // namespace trueflank::loop
