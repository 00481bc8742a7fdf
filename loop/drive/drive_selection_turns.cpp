// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"

// One place of a turn that was taken apart into waves or parts of it, told as one.
namespace trueflank::loop {
namespace {

/// A wave that comes so many whole times in this turn.
bool is_wave_of_turn(const DriveEffect& effect, double order) {
  constexpr double kNear = 0.01;
  const double times = effect.order() / order;
  return times > 0.5 && std::abs(times - std::round(times)) < kNear;
}

bool is_place_of_turn(const DriveEffect& effect, double order) {
  const DriveFamily& family = *effect.family;
  return family.turns_per_turn &&
         std::abs(family.turns_per_turn(effect.shape) - order) < 1e-6 * order;
}

/// A part of a turn has two ends, which are no continuous values.
int figures_of_set(const std::vector<DriveEffect>& effects) {
  int size = size_of(effects);
  for (const DriveEffect& e : effects) size += e.family->shape_of_spell ? 2 : 0;
  return size;
}

}  // namespace

void DriveSelection::tell_as_one_place_of_a_turn(DriveOutcome& outcome) {
  constexpr std::ptrdiff_t kManyWaves = 3;
  std::set<double> turns;
  for (const MemberOrder& member : model_.orders) {
    const auto wave = [&](const DriveEffect& e) { return is_wave_of_turn(e, member.order); };
    const auto place = [&](const DriveEffect& e) { return is_place_of_turn(e, member.order); };
    if (std::any_of(outcome.effects.begin(), outcome.effects.end(), place) ||
        std::count_if(outcome.effects.begin(), outcome.effects.end(), wave) >= kManyWaves)
      turns.insert(member.order);
  }
  const auto bump =
      std::find_if(drive_library().begin(), drive_library().end(),
                   [](const DriveFamily& f) { return f.turns_per_turn && !f.shape_of_spell; });
  // The slowest turn last: what comes once in a fast one comes several times in a slow one.
  for (auto turn = turns.rbegin(); turn != turns.rend(); ++turn) {
    OneForm now{.effects = outcome.effects, .from = {}, .size = figures_of_set(outcome.effects)},
        base;
    std::vector<OneForm> sets;
    const auto fit = [&](OneForm& set) {
      refine_drive_shapes(context(), value_, FitRows::kTraining, set.effects);
      const DriveContext here = context();
      set.square = DriveFit(here, value_, set.effects, FitRows::kTraining).residual_square();
      set.size = figures_of_set(set.effects);
    };
    fit(now);
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      if (is_wave_of_turn(outcome.effects[e], *turn) || is_place_of_turn(outcome.effects[e], *turn))
        continue;
      base.effects.push_back(outcome.effects[e]);
      base.from.push_back(static_cast<int>(e));
    }
    // One of the parts alone, or one that swells and dies away, wherever that is likeliest.
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      if (!is_place_of_turn(outcome.effects[e], *turn)) continue;
      OneForm set = base;
      set.effects.push_back(outcome.effects[e]);
      set.from.push_back(static_cast<int>(e));
      sets.push_back(set);
    }
    const DriveContext here = context();
    const BesideEffects beside(here, value_, base.effects, FitRows::kTraining);
    DriveShape best;
    double most = 0.0;
    for (const double which : drive_effects::directions_alone(here))
      for (const double half : {0.01, 0.02, 0.04, 0.08, 0.15})
        for (double centre = 0.0; centre < 1.0; centre += 0.5 * half)
          for (DriveShape& shape : bump->kin_shapes({*turn, centre, half, which, 0.0}))
            if (const double gain = beside.with({&*bump, shape}).gain; gain > most) {
              most = gain;
              best = std::move(shape);
            }
    if (most > 0.0) {
      OneForm set = base;
      set.effects.push_back({&*bump, best});
      set.from.push_back(-1);
      sets.push_back(set);
    }
    double noise = now.square / std::max(1.0, outcome.rows - now.size);
    for (OneForm& set : sets) {
      fit(set);
      noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
    }
    const OneForm* least = &now;
    for (const OneForm& set : sets)
      if (set.figure(noise) < least->figure(noise)) least = &set;
    if (least != &now &&
        least->effects.size() < outcome.effects.size() + (least->from.back() < 0 ? 1 : 0))
      exchange_effects(outcome, *least, false);
  }
}

}  // namespace trueflank::loop
