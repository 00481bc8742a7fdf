// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/loop/drive/bench_remainder.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/place_profile.h"

// Logs of many rows: effects are sought on some of the rows, and settled on all.
namespace trueflank::loop {
namespace {

/// One row out of every stretch of equal length, at a place of it that follows no period. `table`
/// must outlive them.
BenchTable some_rows_of(const BenchTable& table, std::size_t most) {
  constexpr double kGolden = 0.6180339887498949;
  BenchTable some = without_rows(table);
  const double each = static_cast<double>(table.points.size()) / static_cast<double>(most);
  std::map<int, int> units;  // without those of which no row is left
  for (std::size_t k = 0; k < most; ++k) {
    double whole = 0.0;
    const double part = std::modf(static_cast<double>(k) * kGolden, &whole);
    BenchPoint point =
        table.points.at(static_cast<std::size_t>((static_cast<double>(k) + part) * each));
    point.unit = units.emplace(point.unit, static_cast<int>(units.size())).first->second;
    some.points.push_back(point);
  }
  some.units = static_cast<int>(units.size());
  return some;
}

}  // namespace

bool DriveSelection::is_a_log() const { return table_.points.size() > kMostSoughtRows; }

DriveOutcome DriveSelection::of_a_log() {
  const std::size_t rows = table_.points.size();
  DriveSelection some(
      model_, some_rows_of(table_, rows > kMostSettledRows ? kMostSettledRows : kMostSoughtRows),
      options_);
  DriveOutcome outcome = some.run();
  candidates_ = std::move(some.candidates_);
  banned_ = std::move(some.banned_);
  exchangeable_ = std::move(some.exchangeable_);
  state_ = some.state_;
  vetoed_ = some.vetoed_;
  most_denied_ = some.most_denied_;
  losses_beside_gains_ = some.losses_beside_gains_;
  outcome.rows = rows_of_training();
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    if (!outcome.effects[e].family->falls_in_steps || !outcome.effects[e].family->all_shapes)
      continue;
    const DriveContext here = context();
    std::vector<DriveEffect> others = outcome.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    outcome.effects[e] = nearest_best(here, BesideEffects(here, value_, others, FitRows::kTraining),
                                      outcome.effects[e]);
  }
  refine_drive_shapes(context(), value_, FitRows::kTraining, outcome.effects);
  settle_after_exchange(outcome);
  add_names_that_many_rows_show(outcome);
  drop_what_is_nothing(outcome);
  veto(outcome);
  return outcome;
}

void DriveSelection::add_names_that_many_rows_show(DriveOutcome& outcome) {
  constexpr double kSure = 30.0, kSurest = 1e-9;  // chi-square; p
  constexpr int kMostNames = 3;
  const DriveState state = state_;
  DriveOutcome with = outcome;
  for (int names = 0; names < kMostNames; ++names) {
    const DriveContext here = context();
    const BesideEffects beside(here, value_, with.effects, FitRows::kTraining);
    const double noise = with.shared * beside.square() / std::max(1.0, with.rows - with.size());
    double most = kSure * noise;
    std::size_t best = candidates_.size();
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      const DriveFamily& family = *candidates_[g].family;
      if (banned_[g] || !family.named || candidates_[g].columns() != 1 || with.has(&family))
        continue;
      const BesideEffects::Alone alone = beside.with(candidates_[g]);
      if (alone.gain <= most || (family.only_positive && !(alone.coefficient > 0.0))) continue;
      most = alone.gain;
      best = g;
    }
    if (best == candidates_.size()) break;
    with.effects.push_back(candidates_[best]);
    ChosenGroup record;
    record.group = static_cast<int>(best);
    record.bic_gain = most / noise;
    record.p_value = std::max(kSurest, std::exp(-0.5 * record.bic_gain));
    with.discovery.chosen.push_back(record);
    with.discovery.first_p_value = std::min(with.discovery.first_p_value, record.p_value);
    refine_drive_shapes(context(), value_, FitRows::kTraining, with.effects);
    settle_after_exchange(with);
  }
  if (with.effects.size() == outcome.effects.size()) return;
  // Names that leave something only take a part of what is not understood.
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, with.effects, FitRows::kTraining).explained_nm();
  if (is_possible(with) && ask_remainder(table_, model_.ratio, left).follows.empty() &&
      !is_denied(with))
    outcome = std::move(with);
  else
    state_ = state;
}

}  // namespace trueflank::loop
