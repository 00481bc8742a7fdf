// SPDX-License-Identifier: GPL-3.0-or-later
// Effects are chosen one by one: two that overlap may begin with a third that follows both a
// little, and end in many pieces. Then the choice is made again from the forms that the data as
// they are show.
#include "trueflank/loop/gear/part/other_starts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/part/waves.h"

namespace trueflank::loop {
namespace {

constexpr double kClearlyLess = 9.0;  // chi-square

/// Effects that run over the profile or over the face, a form without a name among them.
bool is_in_pieces(const FlankGeometry& geometry, const std::vector<Effect>& effects) {
  constexpr int kMany = 3;
  for (const Runs runs : {Runs::kOverProfile, Runs::kOverFace}) {
    int count = 0, forms = 0;
    for (const Effect& effect : effects) {
      if (effect.family->local || runs_of(geometry, effect) != runs) continue;
      ++count;
      forms += effect.is_term() ? 1 : 0;
    }
    if (count >= kMany && forms > 0) return true;
  }
  return false;
}

/// The wave that is most of the pieces, then what stands out beside a slope, the largest first.
/// Each takes as long as the first choice: few.
std::vector<RemainderFinding> other_starts(const PartModel& model) {
  constexpr std::size_t kMost = 2;
  std::vector<RemainderFinding> starts;
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
    for (const int face : {0, 1})
      if (std::optional<RemainderFinding> wave = wave_of_pieces(model, face, flank))
        starts.push_back(std::move(*wave));
  std::vector<RemainderFinding> beside = model.beside_slopes;
  std::stable_sort(beside.begin(), beside.end(),
                   [](const auto& a, const auto& b) { return a.square > b.square; });
  for (const RemainderFinding& finding : beside)
    if (std::none_of(starts.begin(), starts.end(),
                     [&](const auto& start) { return *start.effect == *finding.effect; }))
      starts.push_back(finding);
  if (starts.size() > kMost) starts.resize(kMost);
  return starts;
}

/// Of an effect of one column that runs over the profile: no straight lean.
bool bends_over_profile(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kStraight = 1e-6;
  const double root = geometry.root_form_roll_mm(), tip = geometry.tip_form_roll_mm();
  const Flank on = effect.flank == FlankChoice::kLeft ? Flank::kLeft : Flank::kRight;
  const auto at = [&](double share) {
    double value = 0.0;
    effect.evaluate(geometry,
                    geometry.on_flank(1, flank_side(on, geometry.gear().kind),
                                      root + share * (tip - root), 0.5 * geometry.face_width_mm()),
                    &value);
    return value;
  };
  return std::abs(at(0.0) - 2.0 * at(0.5) + at(1.0)) >
         kStraight * (std::abs(at(0.0)) + std::abs(at(1.0)) + std::abs(at(0.5)));
}

}  // namespace

bool begins_better(PartModel& model) {
  // Traces of real gears are in pieces whatever one begins with.
  if (model.table->points_mm.empty() || !model.options.start.empty() || model.asked_for_starts ||
      !is_in_pieces(model.geometry, model.effects))
    return false;
  model.asked_for_starts = true;
  const std::vector<RemainderFinding> starts = other_starts(model);
  const double own_cost = cost_of(model, model.effects);
  double least = kNaN;
  model.problem = {};  // each choice has columns of its own, a fifth of the memory of a large scan
  for (const RemainderFinding& start : starts) {
    PartOptions options = model.options;
    options.given.resize(first_told_here(model));
    options.start = {start};
    SharedTable measured = model.table;
    if (measured->is_displaced) undo_displacement(model.geometry, measured.own());
    auto other =
        std::make_unique<PartModel>(model.geometry, std::move(measured), std::move(options));
    explain_part(*other);
    const double cost = cost_of(*other, other->effects);
    if (other->table->is_displaced || cost >= least) continue;
    least = cost;
    model.other_start = std::move(other);
    if (cost >= own_cost || is_in_pieces(model.geometry, model.other_start->effects)) continue;
    if (structure_is_left(*model.other_start)) {
      if (cost < own_cost - kClearlyLess) return false;
      continue;
    }
    model.remainder = std::move(model.other_start->remainder);
    model.alone = std::move(model.other_start->alone);
    take_over(model, *model.other_start);
    model.other_start.reset();
    return true;
  }
  return false;
}

void take_other_start(PartModel& model) {
  if (begins_better(model) || !model.other_start || model.table->is_displaced ||
      !(cost_of(*model.other_start, model.other_start->effects) <
        cost_of(model, model.effects) - kClearlyLess))
    return;
  model.alone = std::move(model.other_start->alone);
  take_over(model, *model.other_start);
  model.other_start.reset();
}

void doubt_size_of_flanks(PartModel& model) {
  constexpr double kNoLoss = 1e-2;  // of the error's square
  const auto is_size = [](const Effect& e) { return e.family->moves_whole_part; };
  const auto told = model.effects.begin() + static_cast<std::ptrdiff_t>(first_told_here(model));
  const auto size = std::find_if(told, model.effects.end(), is_size);
  if (size == model.effects.end() || model.options.names_only || !model.options.start.empty() ||
      !model.options.without.empty() || model.table->points_mm.empty() ||
      std::any_of(model.table->rows.begin(), model.table->rows.end(),
                  [](const Observation& row) { return row.kind != ObservationKind::kScanFlank; }))
    return;
  const auto runs_over_profile = [&](const Effect& effect) {
    return effect.order() == 0.0 && runs_of(model.geometry, effect) == Runs::kOverProfile;
  };
  const auto bends = [&](const Effect& effect) {
    return effect.columns() > 1 || bends_over_profile(model.geometry, effect);
  };
  if (std::none_of(told, model.effects.end(), [&](const Effect& effect) {
        return runs_over_profile(effect) && bends(effect);
      }))
    return;
  PartOptions options = model.options;
  options.given.resize(first_told_here(model));
  for (const Effect& candidate : model.candidates)
    if (is_size(candidate)) options.without.push_back(candidate.family);
  options.without.push_back(size->family);
  SharedTable measured = model.table;
  if (measured->is_displaced) undo_displacement(model.geometry, measured.own());
  PartModel other(model.geometry, std::move(measured), std::move(options));
  explain_part(other);
  // (with a lean it is the same thickness and lean, as two)
  if (std::any_of(other.effects.begin(), other.effects.end(), [&](const Effect& effect) {
        return runs_over_profile(effect) && !bends(effect);
      }))
    return;
  // (a body that moved has patches, and so weights, of its own: errors are compared, not costs)
  const auto errors_um = [](const PartModel& one) {
    return fit_of(one, one.effects)->errors(std::vector<bool>(one.effects.size(), true)).rms_um;
  };
  const auto n = static_cast<double>(fit_of(model, model.effects)->observations());
  const double loss = n * (std::pow(errors_um(other) / errors_um(model), 2) - 1.0);
  const bool fewer = other.effects.size() < model.effects.size();
  if (loss > (fewer ? kClearlyLess + kNoLoss * n : -kClearlyLess)) return;
  model.alone = std::move(other.alone);
  take_over(model, other);
}

}  // namespace trueflank::loop
