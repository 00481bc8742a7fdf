// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/structure_left.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/part/single_teeth.h"

namespace trueflank::loop {

namespace {

/// Of sizes alone: how likely their stated errors make them differ as much as what effects leave of
/// them. Four may agree with each other by chance far better than that, which says nothing. NaN
/// where there are other data.
double p_value_of_sizes(const PartModel& model) {
  if (!std::all_of(model.table->rows.begin(), model.table->rows.end(),
                   [](const Observation& row) { return row.kind == ObservationKind::kSize; }))
    return kNaN;
  double square = 0.0;
  int count = 0;
  const auto row_um = fit_of(model, model.effects)->residuals_um();
  for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
    const Observation& row = model.table->rows[i];
    if (model.patches.patch_of_row[i] < 0) continue;
    square += std::pow((*row_um)[i] / model.table->size_sigma_um(row), 2);
    ++count;
  }
  constexpr double kKnown = 1e9;  // degrees of freedom of an error that is stated
  return count > 0 ? f_tail(square / count, count, kKnown) : kNaN;
}

bool are_sizes_within_their_errors(const PartModel& model) {
  constexpr double kLevel = 0.01;
  return p_value_of_sizes(model) > kLevel;
}

}  // namespace

bool structure_is_left(const PartModel& model) {
  constexpr double kLeft = 0.01, kLeftOfNothing = 0.01, kSureThoughDenied = 0.0015;
  if (neighbours_share(model) || !model.remainder.empty() || model.denied_spot) return true;
  if (are_sizes_within_their_errors(model)) return false;
  // What the hold-out denied must be surer than what it was not asked about.
  const double sure = model.vetoed ? kSureThoughDenied : kLeftOfNothing;
  if (model.effects.empty()) {
    // Single teeth have a level of their own, at which they were chosen: they are asked again only
    // where the hold-out denied one, and never one of single values, whose tails may be long.
    const double p = model.vetoed && !has_single_values_only(model)
                         ? model.discovery.first_p_value
                         : model.discovery.first_common_p_value;
    return p <= sure / model.options.tables;
  }
  return model.discovery.p_left <= kLeft / model.options.tables &&
         model.discovery.most_likely_left >= 0;
}

WhatIsLeft what_is_left(const PartModel& model) {
  WhatIsLeft left{.nothing = !structure_is_left(model)};
  for (const RemainderFinding& finding : model.remainder) {
    left.own_profiles = left.own_profiles || finding.own == OwnCourse::kProfile;
    left.own_leads = left.own_leads || finding.own == OwnCourse::kLead;
    left.smooth_profiles =
        left.smooth_profiles || (finding.own_relief && finding.own == OwnCourse::kProfile);
    left.smooth_leads =
        left.smooth_leads || (finding.own_relief && finding.own == OwnCourse::kLead);
    if (finding.places.any) left.places = finding.places;
    left.own_waves.insert(left.own_waves.end(), finding.own_waves.begin(), finding.own_waves.end());
  }
  return left;
}

namespace {

/// What is told of a remainder: the surest, or another that is far larger and as good as certain.
const RemainderFinding& most_telling(const std::vector<RemainderFinding>& remainder) {
  constexpr double kFarLarger = 3.0, kSure = 1e-4;
  const RemainderFinding* told = &remainder.front();
  for (const RemainderFinding& finding : remainder)
    if (finding.p_value < kSure &&
        std::abs(finding.amount_um) > kFarLarger * std::abs(told->amount_um))
      told = &finding;
  return *told;
}

/// What is told of a remainder, in words. Waves that traces have each in its phase are told of
/// every flank and direction that has them.
std::string words_of_remainder(const std::vector<RemainderFinding>& remainder) {
  constexpr double kSure = 1e-4;
  constexpr int kMost = 3;
  const RemainderFinding& told = most_telling(remainder);
  std::string text = told.text;
  int more = 0;
  for (const RemainderFinding& finding : remainder)
    if (told.own_phases && finding.own_phases && &finding != &told && finding.p_value < kSure &&
        more++ < kMost)
      text += "; and " + finding.text;
  return text;
}

}  // namespace

double structure_left_p_value(const PartModel& model) {
  if (const double of_sizes = p_value_of_sizes(model); of_sizes > 0.0 && !structure_is_left(model))
    return of_sizes;
  return model.remainder.empty()
             ? model.discovery.p_left
             : std::min(model.discovery.p_left, most_telling(model.remainder).p_value);
}

std::string structure_left(const PartModel& model) {
  if (neighbours_share(model))
    return words_for(model.neighbours) +
           (model.remainder.empty() ? "" : "; and " + words_of_remainder(model.remainder));
  if (!model.remainder.empty()) return words_of_remainder(model.remainder);
  if (model.denied_spot)
    return words_for(model.geometry, *model.denied_spot) +
           ", which the values held out do not bear out";
  if (!structure_is_left(model) || model.discovery.most_likely_left < 0)
    return "nothing beyond the measurement's own noise was found";
  return "what is left looks most like " +
         words_for(model.geometry, model.candidates[model.discovery.most_likely_left]);
}

}  // namespace trueflank::loop
