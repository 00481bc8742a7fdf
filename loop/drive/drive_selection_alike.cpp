// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"

// Forms of which others do alike by chance: a loss of the first rows, a reading that goes no
// further.
namespace trueflank::loop {
namespace {

/// Half way between rows that follow each other, of the few about a place of the run (-1 ... 1).
std::vector<double> ends_about(const std::vector<BenchPoint>& points, double place) {
  constexpr std::ptrdiff_t kAbout = 3;
  std::ptrdiff_t at = 0;
  while (at + 1 < static_cast<std::ptrdiff_t>(points.size()) &&
         2.0 * points[static_cast<std::size_t>(at) + 1].taken - 1.0 < place)
    ++at;
  std::vector<double> ends;
  for (std::ptrdiff_t row = at - kAbout; row <= at + kAbout; ++row)
    if (row >= 0 && row + 1 < static_cast<std::ptrdiff_t>(points.size()))
      ends.push_back(0.5 * (points[static_cast<std::size_t>(row)].taken +
                            points[static_cast<std::size_t>(row) + 1].taken));
  return ends;
}

}  // namespace

/// A name of the whole run and a jump that takes it back are one loss of the rows before the jump.
void DriveSelection::tell_as_first_rows(DriveOutcome& outcome) {
  // (chi-square: of the figure that is less, and of two that take each other back by chance)
  constexpr double kAsWell = 12.0, kReads = 9.0;
  const DriveFamily* host = family_with(&DriveFamily::shape_of_spell);
  for (std::size_t jump = 0; jump < outcome.effects.size(); ++jump) {
    const DriveFamily& family = *outcome.effects[jump].family;
    if (!family.jumps_in_run) continue;
    const std::vector<double> ends = ends_about(table_.points, outcome.effects[jump].shape[1]);
    for (std::size_t name = 0; name < outcome.effects.size(); ++name) {
      const DriveFamily& whole = *outcome.effects[name].family;
      if (!whole.named || outcome.effects[name].columns() != 1 ||
          !outcome.effects[name].shape.empty() || whole.drifts || whole.follows_the_run)
        continue;
      OneForm now = as_it_is(outcome);
      const double noise = now.square / std::max(1.0, outcome.rows - now.size);
      OneForm best;
      double least_of_all = 1e300;
      const double reads = kReads * noise;
      const auto tried = [&](double what, double end) {
        OneForm set;
        for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
          if (e == jump || e == name) continue;
          set.effects.push_back(outcome.effects[e]);
          set.from.push_back(static_cast<int>(e));
        }
        set.effects.push_back({host, host->shape_of_spell(what, 0.0, 0.0, end)});
        set.from.push_back(-1);
        return set;
      };
      for (const double what :
           {drive_effects::kDrag, drive_effects::kFlanks, drive_effects::kOutputReads})
        for (const double end : ends) {
          OneForm set = tried(what, end);
          if (!fits(set)) continue;
          // (a loss that was no reading: only both directions tell them apart; of ends that leave
          // the same of the rows seen all rows tell which)
          const double surely = what == double(drive_effects::kOutputReads) ? reads : 0.0,
                       of_all = square_of_all(set);
          const bool same = std::abs(set.square - best.square) < OneForm::kTheSame * set.square;
          if (same ? of_all + surely >= least_of_all : set.square + surely >= best.square) continue;
          least_of_all = of_all;
          best = std::move(set);
        }
      if (best.effects.empty() || best.square - now.square > kAsWell * noise) continue;
      exchange_effects(outcome, best, false);
      return;
    }
  }
}

/// A reading that stands still from a torque on is a loss that begins there only by chance, and one
/// in a bow over its load is a zero beside a curve: where it leaves as little, it takes their
/// place.
void DriveSelection::tell_as_alike(DriveOutcome& outcome) {
  for (const DriveFamily& family : drive_library())
    if (family.may_stand_for && family.may_stand_for(outcome.effects) &&
        tell_as_alike(outcome, family))
      return;
}

bool DriveSelection::tell_as_alike(DriveOutcome& outcome, const DriveFamily& family) {
  constexpr double kAsWell = 4.0;  // chi-square
  const OneForm now = as_it_is(outcome);
  const double noise = now.square / std::max(1.0, outcome.rows - now.size);
  const DriveState state = state_;
  DriveState best_state = state;
  OneForm best;
  enum Kept { kNames, kNamedLosses, kNone };
  for (const Kept kept : {kNames, kNamedLosses, kNone}) {
    OneForm set;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      const DriveFamily& other = *outcome.effects[e].family;
      if (kept == kNone || !other.named || (kept == kNamedLosses && !other.is_loss)) continue;
      set.effects.push_back(outcome.effects[e]);
      set.from.push_back(static_cast<int>(e));
    }
    // (about the place of what is kept: a scale that goes moves what the others do)
    state_ = state;
    const DriveContext before = context();
    state_ = state_of(DriveFit(before, value_, set.effects, FitRows::kTraining));
    const DriveContext here = context();
    const std::vector<DriveShape> shapes =
        family.whole_shapes ? family.whole_shapes(here) : family.all_shapes(here, nullptr);
    const BesideEffects beside(here, value_, set.effects, FitRows::kTraining);
    DriveEffect likeliest{&family, {}};
    double most = 0.0;
    for (const DriveShape& shape : shapes)
      if (const double gain = beside.with({&family, shape}).gain; gain > most) {
        most = gain;
        likeliest.shape = shape;
      }
    if (!(most > 0.0)) continue;
    set.effects.push_back(nearest_best(here, beside, nearest_best(here, beside, likeliest)));
    set.from.push_back(-1);
    if (!fits(set) || set.figure(noise) >= best.figure(noise)) continue;
    best = std::move(set);
    best_state = state_;
  }
  state_ = state;
  // (every figure that it spares may leave as much)
  const double spared = static_cast<double>(std::max(1, now.size - best.size));
  if (best.effects.empty() || best.size > now.size ||
      best.square - now.square > kAsWell * noise * spared)
    return false;
  state_ = best_state;
  if (exchange_unless_denied(outcome, best, 0.0)) return true;
  state_ = state;
  return false;
}

}  // namespace trueflank::loop
