// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/scans/states_scan.h"

// Levels in place of all that has no name: two of which every row may have either, or ever new ones
// between which the run jumps.
namespace trueflank::loop {
namespace {

/// Of a set that holds what is there at times, by chance: what says when costs as much as chance
/// takes off where every row may be either.
double cost_of_changes(double rows, double changes) {
  if (changes == 0.0) return 0.0;
  const double often = std::clamp(changes / rows, 1.0 / rows, 0.5);
  return -2.0 * rows * (often * std::log(often) + (1.0 - often) * std::log(1.0 - often));
}

/// What neighbouring rows that the fit saw share of what it leaves, in their noise's units.
double alike_in_order(const DriveContext& context, const Eigen::VectorXd& left, double figures) {
  double product = 0.0, square = 0.0, last = 0.0, rows = 0.0;
  const auto& points = context.table.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].fold == 0) continue;
    const double size = left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm;
    product += size * last;
    square += size * size;
    last = size;
    rows += 1.0;
  }
  // (what was fitted makes neighbours look opposite)
  return square > 0.0 ? std::clamp(product / square + (1.0 + figures) / rows, 0.0, 0.95) : 0.0;
}

/// True of levels of which every second one is the same: what is there at times, and at times not.
bool goes_to_and_fro(std::vector<double> levels) {
  constexpr std::size_t kFewest = 4;
  constexpr double kSame = 0.15;  // of how far they reach
  if (levels.size() < kFewest) return false;
  levels.insert(levels.begin(), 0.0);  // before the first change
  const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
  for (std::size_t k = 2; k < levels.size(); ++k)
    if (std::abs(levels[k] - levels[k - 2]) > kSame * (*high - *low)) return false;
  return true;
}

/// At how many rows of the run what stands in a part of it, or jumps in its course, begins and
/// ends.
double changes_in_run(const std::vector<DriveEffect>& effects) {
  double changes = 0.0;
  for (const DriveEffect& e : effects)
    if (e.family->changes_in_run) changes += e.family->changes_in_run(e.shape);
  return changes;
}

}  // namespace

DriveSelection::OneForm DriveSelection::names_beside_levels(const DriveOutcome& outcome,
                                                            bool with_drag) {
  OneForm set;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveFamily& f = *outcome.effects[e].family;
    if (!f.named || f.drifts || f.follows_the_run || (!with_drag && f.follows == "nothing"))
      continue;
    set.effects.push_back(outcome.effects[e]);
    set.from.push_back(static_cast<int>(e));
  }
  return set;
}

void DriveSelection::tell_as_scattered_states(DriveOutcome& outcome) {
  constexpr double kClearly = 20.0, kMostLeft = 0.5;
  if (gains_power() && !losses_beside_gains_) return;
  const OneForm now = as_it_is(outcome);
  const DriveFamily* host = family_with(&DriveFamily::shape_of_states);
  OneForm best;
  double least = 1e300, noise = now.square / std::max(1.0, outcome.rows - now.size);
  for (const bool with_drag : {false, true}) {
    OneForm set = names_beside_levels(outcome, with_drag);
    const DriveContext here = context();
    LikeliestStates states;
    Eigen::VectorXd left =
        value_ - DriveFit(here, value_, set.effects, FitRows::kTraining).explained_nm();
    for (int round = 0; round < 3; ++round) {
      states = scattered_states(here, left);
      if (states.changes.empty()) break;
      std::vector<DriveEffect> together = set.effects;
      together.push_back({host, host->shape_of_states(states.what, states.changes)});
      const DriveFit fit(here, value_, together, FitRows::kTraining);
      left = value_ - fit.explained_nm() + fit.explained_nm(static_cast<int>(together.size()) - 1);
    }
    if (states.changes.empty()) continue;
    set.effects.push_back({host, host->shape_of_states(states.what, states.changes)});
    set.from.push_back(-1);
    if (!fits(set)) continue;
    set.size = size_of(set.effects);
    noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
    const double figure = set.figure(noise) +
                          cost_of_changes(outcome.rows, static_cast<double>(states.changes.size()));
    if (figure >= least) continue;
    least = figure;
    best = set;
  }
  if (best.effects.empty() || best.square > kMostLeft * now.square) return;
  const double gain = now.figure(noise) - least;
  if (gain < kClearly) return;
  exchange_as_sure(outcome, best, gain);
}

void DriveSelection::tell_as_levels_of_the_run(DriveOutcome& outcome) {
  constexpr double kClearly = 30.0, kAsOne = 4.0, kMostLeft = 0.8;
  constexpr double kOfAnEffect = 6.0;  // chi-square
  constexpr std::size_t kFewestLevels = 2, kMostLevels = 12;
  const bool both = table_.has(true) && table_.has(false);
  const OneForm now = as_it_is(outcome);
  OneForm best;
  double least = 1e300, shared = 1.0, noise = now.square / std::max(1.0, outcome.rows - now.size);
  for (const DriveFamily& family : drive_library()) {
    // (of one direction a zero says what a loss would)
    if (!family.shape_of_levels || !may_be_there(family) || (family.is_loss && !both)) continue;
    const double what = family.is_loss ? drive_effects::kDrag : drive_effects::kOutputReads;
    // (a name may only have mended what levels do: it goes where less is left without it)
    for (OneForm set :
         {OneForm{}, names_beside_levels(outcome, false), names_beside_levels(outcome, true)}) {
      const DriveContext here = context();
      Eigen::VectorXd left =
          value_ - DriveFit(here, value_, set.effects, FitRows::kTraining).explained_nm();
      const std::size_t at = set.effects.size();
      LevelsOfRun levels;
      for (int round = 0; round < 3; ++round) {
        levels = likeliest_levels(here, left, what);
        if (levels.changes.size() < kFewestLevels || levels.changes.size() > kMostLevels) break;
        set.effects.resize(at);
        set.effects.push_back(
            {&family, family.shape_of_levels(what, levels.changes, levels.levels)});
        const DriveFit fit(here, value_, set.effects, FitRows::kTraining);
        left = value_ - fit.explained_nm() + fit.explained_nm(static_cast<int>(at));
      }
      if (levels.changes.size() < kFewestLevels || levels.changes.size() > kMostLevels ||
          goes_to_and_fro(levels.levels))
        continue;
      set.from.push_back(-1);
      if (!fits(set)) continue;
      const double changes = static_cast<double>(levels.changes.size());
      set.size = size_of(set.effects) - 1 + 2 * static_cast<int>(levels.changes.size());
      noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
      const double figure = set.figure(noise) + cost_of_changes(outcome.rows, changes);
      if (figure >= least) continue;
      least = figure;
      best = set;
      const double alike = alike_in_order(
          here, value_ - DriveFit(here, value_, set.effects, FitRows::kTraining).explained_nm(),
          set.size);
      shared = (1.0 + alike) / (1.0 - alike);
    }
  }
  // (one in place of several need not do more)
  const bool fewer = best.effects.size() < outcome.effects.size();
  if (best.effects.empty() || (!fewer && best.square > kMostLeft * now.square)) return;
  // (errors that hang together jump between levels as well)
  const double gain = now.figure(noise) - least +
                      cost_of_changes(outcome.rows, changes_in_run(outcome.effects)) -
                      (1.0 - 1.0 / shared) * std::max(0.0, now.square - best.square) / noise;
  const double of_effects = kOfAnEffect * (static_cast<double>(outcome.effects.size()) -
                                           static_cast<double>(best.effects.size()));
  if (gain < (fewer ? kAsOne - of_effects : kClearly)) return;
  (void)exchange_unless_denied(outcome, best, gain);
}

}  // namespace trueflank::loop
