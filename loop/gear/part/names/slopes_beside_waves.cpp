// SPDX-License-Identifier: GPL-3.0-or-later
// Straight slopes beside waves along the same direction, which were told as what is bent.
#include "trueflank/loop/gear/part/names/slopes_beside_waves.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

/// What runs along a direction, the same on every flank.
struct AlongOneDirection {
  bool waves = false, straight = false;
  std::vector<std::size_t> bent;
};

AlongOneDirection along_direction(const PartModel& model, Runs runs) {
  AlongOneDirection found;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth || effect.family->local ||
        effect.family->shape_is_step || runs_of(model.geometry, effect) != runs)
      continue;
    if (effect.family == find_family("unnamed_waves_changing"))
      found.waves = true;
    else if (is_straight(model.geometry, effect))
      found.straight = true;
    else if (effect.columns() == 1)
      found.bent.push_back(e);
  }
  return found;
}

/// Waves in a millimetre at either end a little more or fewer: where they fit is narrow along
/// neither of their two values.
std::vector<EffectShape> changed_at_the_ends(const EffectShape& shape) {
  constexpr std::array<double, 7> kTimes{0.97, 0.99, 0.997, 1.0, 1.003, 1.01, 1.03};
  std::vector<EffectShape> shapes;
  for (const double low : kTimes)
    for (const double high : kTimes) {
      const double at_low = low * (1.0 - shape[2]), at_high = high * (1.0 + shape[2]);
      if (at_low > 0.0 && at_high > 0.0)
        shapes.push_back({shape[0], 2.0 * shape[1] / (at_low + at_high),
                          (at_high - at_low) / (at_high + at_low)});
    }
  return shapes;
}

/// True where such waves moved.
bool move_at_the_ends(TrialFit& fit) {
  constexpr double kWorthIt = 0.1;  // chi-square: a third of an error
  constexpr int kMostSteps = 24;
  bool moved = false;
  std::vector<Effect> effects = fit.effects();
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (effects[e].family != find_family("unnamed_waves_changing")) continue;
    for (int step = 0; step < kMostSteps; ++step) {
      const std::vector<EffectShape> tried = changed_at_the_ends(effects[e].shape);
      const std::vector<TrialFit::Trial> trials = fit.with_shapes(e, tried, 0.0);
      const auto least =
          std::min_element(trials.begin(), trials.end(),
                           [](const auto& a, const auto& b) { return a.square < b.square; });
      if (!(least->square < fit.residual_square() - kWorthIt)) break;
      effects[e].shape = tried[static_cast<std::size_t>(least - trials.begin())];
      fit.set_shapes(effects);
      moved = true;
    }
  }
  return moved;
}

/// The same with all places and lengths where least is left.
std::vector<Effect> settled(const PartModel& model, std::vector<Effect> effects) {
  constexpr int kMostTurns = 4;
  TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, effects);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    refine_shapes(model.geometry, first_told_here(model), fit);
    const bool nearby = refine_nearby(model.geometry, fit);
    if (!move_at_the_ends(fit) && !nearby) break;
  }
  return fit.effects();
}

void tell_slope_beside_waves(PartModel& model, int face) {
  constexpr double kClearly = 1.0;  // chi-square
  const AlongOneDirection along =
      along_direction(model, face == 0 ? Runs::kOverProfile : Runs::kOverFace);
  if (!along.waves || (along.bent.empty() && !along.straight)) return;
  const std::vector<Effect> now = settled(model, model.effects);
  const double own = cost_of(model, now);
  if (along.straight && along.bent.empty() && own < cost_of(model, model.effects) - kClearly)
    put_in_place_of(model, {}, now);
  // (names that are straight are the same to waves: the most usual)
  const std::vector<Effect> names = names_along(model, face);
  const auto slope = std::find_if(names.begin(), names.end(), [&](const Effect& name) {
    return name.flank == FlankChoice::kBoth && is_straight(model.geometry, name);
  });
  if (slope == names.end() && !along.straight) return;
  CheapestAnswer best{.least = own};
  for (const std::vector<std::size_t>& these : all_pairs_and_each(along.bent)) {
    std::vector<Effect> with = without(model.effects, these);
    if (!along.straight) with.push_back(*slope);
    with = settled(model, std::move(with));
    if (along.straight ||
        is_possible(model.geometry, *fit_of(model, with), static_cast<int>(with.size()) - 1))
      best.ask(model, std::move(with), these);
  }
  if (!best.effects.empty()) put_in_place_of(model, best.these, best.effects);
}

}  // namespace

void tell_slopes_beside_waves(PartModel& model) {
  if (model.options.joined || model.options.names_only || !model.table->points_mm.empty()) return;
  for (const int face : {0, 1}) tell_slope_beside_waves(model, face);
}

}  // namespace trueflank::loop
