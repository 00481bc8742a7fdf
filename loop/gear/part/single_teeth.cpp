// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked beside the choice: single teeth, sizes, and what a few teeth side by side share.
#include "trueflank/loop/gear/part/single_teeth.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/records.h"

namespace trueflank::loop {
namespace {

/// A tooth that stands aside or out on both flanks by two values of an index, of which one is far
/// off and the other, by half of that, is not: one flank's.
void tell_flank_of_index(PartModel& model) {
  constexpr double kClearly = 2.0;  // chi-square
  if (!has_single_values_only(model)) return;
  for (std::size_t e = model.options.given.size(); e < model.effects.size(); ++e) {
    const Effect tooth = model.effects[e];
    if (!tooth.family->local || tooth.columns() != 1 || tooth.flank != FlankChoice::kBoth) continue;
    double least = fit_of(model, model.effects)->residual_square() - kClearly;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<Effect> with = model.effects;
      with[e] = {find_family("unnamed_flank"), flank, {tooth.shape[0]}};
      const auto candidate = std::find(model.candidates.begin(), model.candidates.end(), with[e]);
      if (candidate == model.candidates.end()) continue;
      const double left = fit_of(model, with)->residual_square();
      if (!(left < least)) continue;
      least = left;
      model.effects = std::move(with);
      model.discovery.chosen[e].group = static_cast<int>(candidate - model.candidates.begin());
    }
  }
}

}  // namespace

void look_at_single_teeth(PartModel& model) {
  std::vector<Effect> local;
  for (const Effect& effect : model.candidates) {
    if (!effect.family->local) continue;
    const bool chosen =
        std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& e) {
          return e.family == effect.family && e.shape == effect.shape && e.flank == effect.flank;
        });
    if (!chosen) local.push_back(effect);
  }
  DiscoveryProblem problem = make_problem(model.geometry, model.table, model.patches, local);
  add_nuisance(problem, make_problem(model.geometry, model.table, model.patches, model.effects));
  for (int& fold : problem.fold)
    if (fold == 0) fold = 1;
  DiscoveryOptions options;
  options.first_level = options.next_level = 0.0;
  // Of values one a tooth alone the tails are asked besides.
  constexpr double kBesideTails = 0.002;
  options.local_level = has_single_values_only(model) ? kBesideTails : level_of_tooth(model);
  options.local_level /= model.options.tables;
  options.flips = 1;
  options.most_effects = 3;
  for (const ChosenGroup& chosen : discover(problem, options).chosen) {
    model.effects.push_back(local[chosen.group]);
    ChosenGroup record = chosen;
    record.group = -1;
    model.discovery.chosen.push_back(record);
  }
  tell_flank_of_index(model);
  drop_teeth_within_the_tails(model);
  drop_teeth_within_their_error(model);
}

double level_of_tooth(const PartModel& model) {
  constexpr double kOfScans = 2e-4, kOfOthers = 0.002;
  return model.table->points_mm.empty() ? kOfOthers : kOfScans;
}

void drop_teeth_within_their_error(PartModel& model) {
  constexpr double kLooksOfTooth = 4.0;  // out on both flanks, aside, and out on either
  constexpr double kByChance = 0.002;
  if (model.table->points_mm.empty()) return;
  const auto first = static_cast<std::ptrdiff_t>(first_told_here(model));
  while (std::any_of(model.effects.begin() + first, model.effects.end(),
                     [](const Effect& effect) { return effect.family->local; })) {
    const auto fit = fit_of(model, model.effects);
    std::size_t worst = model.effects.size();
    double most = kByChance / (kLooksOfTooth * model.geometry.teeth() * model.options.tables);
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      if (!model.effects[e].family->local || model.effects[e].columns() != 1) continue;
      const int column = fit->first_column(static_cast<int>(e));
      const double error = std::sqrt(fit->covariance()(column, column));
      if (!(error > 0.0)) continue;
      const double p = student_two_sided(fit->coefficients()[column] / error, fit->degrees(column));
      if (!(p > most)) continue;
      most = p;
      worst = e;
    }
    if (worst == model.effects.size()) return;
    remove_effect(model, worst);
  }
}

std::vector<std::size_t> shown_by_held_out_alone(const PartModel& model,
                                                 const PointFit::HeldOutBesideLocal& held_out) {
  constexpr std::size_t kMost = 2;
  const std::vector<std::size_t>& these = held_out.fitted_there;
  if (these.size() <= kMost) return these;
  const double tooth =
      model.effects[these.front()].shape.empty() ? kNaN : model.effects[these.front()].shape[0];
  const bool of_one_tooth = std::all_of(these.begin(), these.end(), [&](std::size_t e) {
    const Effect& effect = model.effects[e];
    return (effect.family->local || effect.family->is_of_one_tooth) && effect.shape[0] == tooth;
  });
  return of_one_tooth ? these : std::vector<std::size_t>();
}

void look_at_sizes(PartModel& model) {
  constexpr double kSure = 1e-3, kTie = 4.0;
  const auto sizes =
      std::count_if(model.table->rows.begin(), model.table->rows.end(),
                    [](const Observation& row) { return row.kind == ObservationKind::kSize; });
  for (int round = 0; round < 2 && sizes > 0; ++round) {
    const double before = fit_of(model, model.effects)->residual_square();
    int best = -1;
    std::vector<std::pair<int, double>> tried;
    for (int g = 0; g < static_cast<int>(model.candidates.size()); ++g) {
      const Effect& effect = model.candidates[g];
      if (!effect.family->shows_in_sizes || model.banned[g] ||
          std::any_of(model.effects.begin(), model.effects.end(),
                      [&](const Effect& e) { return e.family == effect.family; }))
        continue;
      std::vector<Effect> with = model.effects;
      with.push_back(effect);
      const PointFit fit(model.geometry, model.table, model.patches, with);
      if (fit.retained(fit.first_column(static_cast<int>(model.effects.size()))) < 2e-3) continue;
      tried.emplace_back(g, before - fit.residual_square());
      if (best < 0 || tried.back().second > tried[best].second)
        best = static_cast<int>(tried.size()) - 1;
    }
    if (best < 0) return;
    const double tests = static_cast<double>(tried.size()) * model.options.tables;
    const double best_gain = tried[best].second;
    const double alone = model.table->size_degrees > 0
                             ? f_tail(best_gain, 1.0, model.table->size_degrees)
                             : std::exp(-minus_log_chi_square_tail(best_gain, 1));
    const double p = std::min(1.0, tests * alone);
    if (p > kSure) return;
    ChosenGroup record;
    record.group = tried[best].first;
    record.p_value = p;
    for (const auto& [group, gain] : tried)
      if (group != record.group && tried[best].second - gain < kTie)
        record.confounded.push_back(group);
    model.effects.push_back(model.candidates[record.group]);
    model.discovery.chosen.push_back(record);
  }
}

void look_at_neighbours(PartModel& model) {
  std::vector<Effect> common;
  for (const Effect& effect : model.effects)
    if (!effect.family->local) common.push_back(effect);
  model.neighbours = shared_beside(model, common);
  if (common.size() == model.effects.size()) return;
  SharedByNeighbours beside_all = shared_beside(model, model.effects);
  const int z = model.geometry.teeth();
  const auto is_of_them = [&](const Effect& effect) {
    if (!effect.family->local) return false;
    const int off = std::abs(static_cast<int>(effect.shape[0]) - model.neighbours.tooth);
    return std::min(off, z - off) <= 1;
  };
  // Teeth side by side that leave nothing shared say what it is.
  std::set<double> teeth;
  for (const Effect& effect : model.effects)
    if (is_of_them(effect)) teeth.insert(effect.shape[0]);
  if (!neighbours_share(model) || (teeth.size() > 1 && !is_shared(model, beside_all))) {
    model.neighbours = std::move(beside_all);
    return;
  }
  for (std::size_t e = model.effects.size(); e-- > model.options.given.size();)
    if (is_of_them(model.effects[e])) remove_effect(model, e);
}

SharedByNeighbours shared_beside(const PartModel& model, const std::vector<Effect>& effects) {
  return shared_by_neighbours(model.geometry, model.patches,
                              *fit_of(model, effects)->residuals_um());
}

bool is_shared(const PartModel& model, const SharedByNeighbours& shared) {
  return shared.p_value <= 0.002 / model.options.tables;
}

bool neighbours_share(const PartModel& model) { return is_shared(model, model.neighbours); }

}  // namespace trueflank::loop
