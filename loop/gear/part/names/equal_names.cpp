// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/names/equal_names.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/loop/gear/possible_effects.h"

namespace trueflank::loop {
namespace {

bool is_of_one_side(const PartModel& model) {
  int side = 0;
  for (const Observation& row : model.table->rows) {
    if (row.places != 1) return false;
    const Place& place = model.table->place(row);
    if (place.surface != Surface::kFlank || (side != 0 && place.side != side)) return false;
    side = place.side;
  }
  return side != 0;
}

bool is_name_without_a_place(const Effect& effect) {
  return effect.family->named && !effect.family->local &&
         (effect.shape.empty() || effect.order() > 0.0);
}

/// Of names that leave as much, one that a flank can have alone, told of the flank that was
/// measured: the other flank need not have it.
void tell_of_the_flank_measured(PartModel& model, std::size_t e) {
  if (e < model.options.given.size() || model.effects[e].family->one_flank_too) return;
  const Observation& any = model.table->rows.front();
  const FlankChoice measured = flank_of(model.geometry, model.table->place(any));
  for (int& group : model.discovery.chosen[e].confounded) {
    const Effect& name = model.candidates[static_cast<std::size_t>(group)];
    if (!name.family->one_flank_too || name.flank != measured || !name.shape.empty()) continue;
    const auto told = std::find(model.candidates.begin(), model.candidates.end(), model.effects[e]);
    if (told == model.candidates.end()) return;
    model.discovery.chosen[e].group = group;
    model.effects[e] = name;
    group = static_cast<int>(told - model.candidates.begin());
    return;
  }
}

}  // namespace

void tell_names_that_one_side_leaves_open(PartModel& model) {
  constexpr double kEqual = 1e-3;  // chi-square: the same columns
  if (model.options.joined || model.table->rows.empty() || !is_of_one_side(model)) return;
  const auto fit = fit_of(model, model.effects);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect told = model.effects[e];
    if (!is_name_without_a_place(told)) continue;
    std::vector<int>& like = model.discovery.chosen[e].confounded;
    for (std::size_t g = 0; g < model.candidates.size(); ++g) {
      const Effect& name = model.candidates[g];
      if (model.unseen[g] || !is_name_without_a_place(name) || name.family == told.family ||
          name.columns() != told.columns() ||
          std::find(model.effects.begin(), model.effects.end(), name) != model.effects.end() ||
          std::find(like.begin(), like.end(), static_cast<int>(g)) != like.end())
        continue;
      std::vector<Effect> with = model.effects;
      with[e] = name;
      const auto other = fit_of(model, with);
      if (std::abs(other->residual_square() - fit->residual_square()) <
              kEqual * std::max(1.0, fit->residual_square()) &&
          is_possible(model.geometry, *other, static_cast<int>(e)))
        like.push_back(static_cast<int>(g));
    }
    tell_of_the_flank_measured(model, e);
  }
}

}  // namespace trueflank::loop
