// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is asked beside the choice: single teeth, sizes, and what a few teeth side by side share.
#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/part/part_loop.h"

namespace trueflank::loop {

/// Index, runout and sizes: no trace, no scan.
bool PartLoop::has_single_values_only() const {
  return std::none_of(table_->rows.begin(), table_->rows.end(), [](const Observation& row) {
    return row.kind != ObservationKind::kIndex && row.kind != ObservationKind::kRadial &&
           row.kind != ObservationKind::kSize;
  });
}

/// Single teeth once more with the hold-out: what stands in one tooth cannot be learnt from others.
void PartLoop::look_at_single_teeth() {
  std::vector<Effect> local;
  for (const Effect& effect : candidates_) {
    if (!effect.family->local) continue;
    const bool chosen = std::any_of(effects_.begin(), effects_.end(), [&](const Effect& e) {
      return e.family == effect.family && e.shape == effect.shape && e.flank == effect.flank;
    });
    if (!chosen) local.push_back(effect);
  }
  DiscoveryProblem problem = make_problem(geometry_, table_, patches_, local);
  add_nuisance(problem, make_problem(geometry_, table_, patches_, effects_));
  for (int& fold : problem.fold)
    if (fold == 0) fold = 1;
  DiscoveryOptions options;
  options.first_level = options.next_level = 0.0;
  // Of values one a tooth alone the tails are asked besides.
  constexpr double kBesideTails = 0.01;
  if (has_single_values_only()) options.local_level = kBesideTails;
  options.local_level /= options_.tables;
  options.flips = 1;
  options.most_effects = 3;
  for (const ChosenGroup& chosen : discover(problem, options).chosen) {
    effects_.push_back(local[chosen.group]);
    ChosenGroup record = chosen;
    record.group = -1;
    discovery_.chosen.push_back(record);
  }
  drop_teeth_within_the_tails();
}

/// Sizes are few and know their own error: what they say of thickness, which traces with zeros of
/// their own cannot show, is judged by chi-square.
void PartLoop::look_at_sizes() {
  constexpr double kSure = 1e-3, kTie = 4.0;
  const auto sizes =
      std::count_if(table_->rows.begin(), table_->rows.end(),
                    [](const Observation& row) { return row.kind == ObservationKind::kSize; });
  for (int round = 0; round < 2 && sizes > 0; ++round) {
    const double before = fit_of(effects_)->residual_square();
    int best = -1;
    std::vector<std::pair<int, double>> tried;
    for (int g = 0; g < static_cast<int>(candidates_.size()); ++g) {
      const Effect& effect = candidates_[g];
      if (!effect.family->shows_in_sizes || banned_[g] ||
          std::any_of(effects_.begin(), effects_.end(),
                      [&](const Effect& e) { return e.family == effect.family; }))
        continue;
      std::vector<Effect> with = effects_;
      with.push_back(effect);
      const PointFit fit(geometry_, table_, patches_, with);
      if (fit.retained(fit.first_column(static_cast<int>(effects_.size()))) < 2e-3) continue;
      tried.emplace_back(g, before - fit.residual_square());
      if (best < 0 || tried.back().second > tried[best].second)
        best = static_cast<int>(tried.size()) - 1;
    }
    if (best < 0) return;
    const double tests = static_cast<double>(tried.size()) * options_.tables;
    const double best_gain = tried[best].second;
    const double alone = table_->size_degrees > 0
                             ? f_tail(best_gain, 1.0, table_->size_degrees)
                             : std::exp(-minus_log_chi_square_tail(best_gain, 1));
    const double p = std::min(1.0, tests * alone);
    if (p > kSure) return;
    ChosenGroup record;
    record.group = tried[best].first;
    record.p_value = p;
    for (const auto& [group, gain] : tried)
      if (group != record.group && tried[best].second - gain < kTie)
        record.confounded.push_back(group);
    effects_.push_back(candidates_[record.group]);
    discovery_.chosen.push_back(record);
  }
}

/// What stands over a few teeth is no wave: many small terms, none of which is found by itself. Nor
/// is it a single tooth where the teeth beside it share it.
void PartLoop::look_at_neighbours() {
  std::vector<Effect> common;
  for (const Effect& effect : effects_)
    if (!effect.family->local) common.push_back(effect);
  const auto shared_without = [&](const std::vector<Effect>& effects) {
    return shared_by_neighbours(geometry_, patches_, *fit_of(effects)->residuals_um());
  };
  neighbours_ = shared_without(common);
  if (common.size() == effects_.size()) return;
  if (!neighbours_share()) {
    neighbours_ = shared_without(effects_);
    return;
  }
  const int z = geometry_.teeth();
  for (std::size_t e = effects_.size(); e-- > options_.given.size();) {
    if (!effects_[e].family->local) continue;
    const int off = std::abs(static_cast<int>(effects_[e].shape[0]) - neighbours_.tooth);
    if (std::min(off, z - off) > 1) continue;
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
    discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
  }
}

bool PartLoop::neighbours_share() const { return neighbours_.p_value <= 0.002 / options_.tables; }

}  // namespace trueflank::loop
