// SPDX-License-Identifier: GPL-3.0-or-later
// Straight slopes beside waves along the same direction, which were told as what is bent.
#include "trueflank/loop/gear/part/slopes_beside_waves.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/fit/flank_courses.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names_beside_forms.h"
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
    if (effect.columns() == 2 && effect.family->nearby && is_common_form(effect))
      found.waves = true;
    else if (is_straight(model.geometry, effect))
      found.straight = true;
    else if (effect.columns() == 1)
      found.bent.push_back(e);
  }
  return found;
}

/// The same with all places and lengths where least is left.
std::vector<Effect> settled(const PartModel& model, std::vector<Effect> effects) {
  constexpr int kMostTurns = 4;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    refine_shapes(model.geometry, model.table, model.patches, effects, first_told_here(model));
    if (!refine_nearby(model.geometry, model.table, model.patches, effects)) break;
  }
  return effects;
}

void tell_slope_beside_waves(PartModel& model, int face) {
  constexpr double kClearly = 4.0;  // chi-square
  const AlongOneDirection along =
      along_direction(model, face == 0 ? Runs::kOverProfile : Runs::kOverFace);
  if (!along.waves || (along.bent.empty() && !along.straight)) return;
  const std::vector<Effect> now = settled(model, model.effects);
  const double own = cost_of(model, now);
  if (along.straight && along.bent.empty() && own < cost_of(model, model.effects) - kClearly)
    put_in_place_of(model, {}, now);
  if (along.straight) return;
  // (names that are straight are the same to waves: the most usual)
  const std::vector<Effect> names = names_along(model, face);
  const auto slope = std::find_if(names.begin(), names.end(), [&](const Effect& name) {
    return name.flank == FlankChoice::kBoth && is_straight(model.geometry, name);
  });
  if (slope == names.end()) return;
  CheapestAnswer best{.least = own};
  for (const std::vector<std::size_t>& these : all_pairs_and_each(along.bent)) {
    std::vector<Effect> with = without(model.effects, these);
    with.push_back(*slope);
    with = settled(model, std::move(with));
    if (is_possible(model.geometry, *fit_of(model, with), static_cast<int>(with.size()) - 1))
      best.ask(model, std::move(with), these);
  }
  if (!best.effects.empty()) put_in_place_of(model, best.these, best.effects);
}

}  // namespace

void tell_slopes_beside_waves(PartModel& model) {
  if (model.options.joined || model.options.names_only) return;
  for (const int face : {0, 1}) tell_slope_beside_waves(model, face);
}

}  // namespace trueflank::loop
