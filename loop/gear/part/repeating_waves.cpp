// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/repeating_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {
namespace {

/// What waves add up to on every tooth [um], on the flank that lies counter-clockwise.
std::vector<double> on_teeth_um(const PartModel& model, const std::vector<std::size_t>& waves) {
  const FlankGeometry& geometry = model.geometry;
  const auto fit = fit_of(model, model.effects);
  const double roll = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm());
  std::vector<double> um;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    double& sum = um.emplace_back(0.0);
    for (const std::size_t e : waves) {
      std::array<double, 8> columns{};
      model.effects[e].evaluate(geometry,
                                geometry.on_flank(tooth, 1, roll, 0.5 * geometry.face_width_mm()),
                                columns.data());
      for (int c = 0; c < model.effects[e].columns(); ++c)
        sum += columns[static_cast<std::size_t>(c)] *
               fit->coefficients()[fit->first_column(static_cast<int>(e)) + c];
    }
  }
  return um;
}

/// Waves of both flanks, each tooth as it stands, of orders that are multiples; opposite on the
/// flanks, so that the teeth stand aside, or alike.
std::vector<std::size_t> waves_of(const PartModel& model, int of, bool opposite) {
  const FlankGeometry& geometry = model.geometry;
  const double roll = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm()),
               middle = 0.5 * geometry.face_width_mm();
  std::vector<std::size_t> waves;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool alternates = effect.family == find_family("unnamed_alternation") &&
                            effect.shape[0] == 0.0 && effect.shape[1] == 0.0;
    if (effect.flank != FlankChoice::kBoth || effect.family->displacement_mm ||
        !(alternates || (is_wave_around(effect) && effect.columns() == 2)) ||
        std::remainder(alternates ? 0.5 * geometry.teeth() : effect.order(), double(of)) != 0.0)
      continue;
    std::array<double, 2> one{}, other{};
    effect.evaluate(geometry, geometry.on_flank(1, 1, roll, middle), one.data());
    effect.evaluate(geometry, geometry.on_flank(1, -1, roll, middle), other.data());
    if ((one[0] * other[0] + one[1] * other[1] < 0.0) == opposite) waves.push_back(e);
  }
  return waves;
}

/// The first teeth's values as a pattern, about their mean and of a mean square of 1.
Effect pattern_of(const std::vector<double>& um, int every, bool opposite) {
  std::vector<double> own(um.begin(), um.begin() + every);
  double mean = 0.0, square = 0.0;
  for (const double value : own) mean += value / every;
  for (const double value : own) square += (value - mean) * (value - mean) / every;
  EffectShape shape{double(every), 1.0, opposite ? 1.0 : 0.0};
  for (const double value : own) shape.push_back((value - mean) / std::sqrt(square));
  return {find_family("unnamed_pattern"), FlankChoice::kBoth, std::move(shape)};
}

}  // namespace

void tell_waves_as_pattern(PartModel& model) {
  constexpr int kFewest = 3, kMost = 8, kOfMachines = 7;
  constexpr double kNothing = 4.0;  // chi-square
  if (model.table->points_mm.empty() || model.options.joined) return;
  const int z = model.geometry.teeth();
  for (int every = kFewest; every <= kMost; ++every)
    for (const bool opposite : {true, false}) {
      if (z % every != 0 || z / every < 2) continue;
      const std::vector<std::size_t> waves = waves_of(model, z / every, opposite);
      const bool alone = every == kFewest && z / every > kOfMachines;
      if (waves.size() < (alone ? 1U : 2U)) continue;
      std::vector<Effect> with;
      for (std::size_t e = 0; e < model.effects.size(); ++e)
        if (std::find(waves.begin(), waves.end(), e) == waves.end())
          with.push_back(model.effects[e]);
      with.push_back(pattern_of(on_teeth_um(model, waves), every, opposite));
      if (fit_of(model, with)->residual_square() >
          fit_of(model, model.effects)->residual_square() + kNothing)
        continue;
      put_in_place_of(model, waves, with);
      return;
    }
}

}  // namespace trueflank::loop
