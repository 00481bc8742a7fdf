// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_stages.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/search/search_values.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

/// Figures of a whole are at least (most) those of its stages, but for rounding.
constexpr double kSlack = 1.0 + 1e-6;
/// Allowable torque of a whole against the first stage's times ratio and efficiency behind it.
constexpr double kTorqueSlack = 1.05;

bool is_of_each_stage(SearchObjective figure) {
  return figure == SearchObjective::kSize || figure == SearchObjective::kContactRatio ||
         figure == SearchObjective::kSliding;
}

ToldEfficiencies told_of(const SearchRequirements& r, const StagePair& pair) {
  const auto &first = pair.candidates[0], &second = pair.candidates[1];
  return told_efficiencies(r, signed_ratio(pair), first.forward * second.forward,
                           first.backward * second.backward);
}

/// A stage's share in the objectives of the whole. A weighted product comes first as the stage's
/// own, with each of its factors: what a stage gives up of one depends on the other stage.
std::vector<SearchObjective> objectives_of_stage(const SearchRequirements& r) {
  std::vector<SearchObjective> own;
  const auto add = [&](SearchObjective objective) {
    if (std::find(own.begin(), own.end(), objective) == own.end()) own.push_back(objective);
  };
  const auto add_factors = [&](SearchObjective objective) {
    if (objective == SearchObjective::kTorqueDensity) {
      add(SearchObjective::kTorque);
      add(SearchObjective::kMass);
    } else {
      add(objective);
    }
  };
  for (const SearchObjective objective : r.objectives) add_factors(objective);
  for (const ObjectiveWeight& w : r.weights) add_factors(w.objective);
  return own;
}

/// How much of the first stage's torque is asked for behind it; NaN: nothing is.
double torque_before(const SearchRequirements& r, const StagePair& pair) {
  return r.output_torque_nm.value_or(kNaN) /
         (std::abs(signed_ratio(pair.sets[1])) * pair.candidates[1].forward);
}

}  // namespace

SearchRequirements stage_requirements(const SearchRequirements& r, const ToothSet& set) {
  SearchRequirements own = r;
  const int stage = set.train->stage;
  if (stage == 0) return own;
  own.losses.reset();
  own.objectives = objectives_of_stage(r);
  std::erase_if(own.figure_limits,
                [](const FigureLimit& limit) { return !is_of_each_stage(limit.figure); });
  if (!r.outer_diameter_mm) {
    own.backlash_mm = r.backlash_mm.value_or(kUsualBacklash * r.module_mm);
    own.module_mm = r.module_mm * set.layer2_module_ratio;
  }
  if (stage == 1) own.output_torque_nm.reset();  // depends on the second
  return own;
}

SetResult optimise_set_or_stage(const SearchRequirements& r, const ToothSet& set,
                                const LimitReserve& reserve) {
  return set.train->stage == 0 ? optimise_set(r, set, reserve)
                               : optimise_set(stage_requirements(r, set), set, reserve);
}

double signed_ratio(const StagePair& pair) {
  return signed_ratio(pair.sets[0]) * signed_ratio(pair.sets[1]);
}

GearboxDesign design_of_stages(const SearchRequirements& r, const StagePair& pair) {
  const auto own_design = [&](std::size_t stage) {
    const SearchRequirements own = stage_requirements(r, pair.sets[stage]);
    const SearchCandidate& candidate = pair.candidates[stage];
    return SearchModel(own, pair.sets[stage]).design(candidate.free, candidate.dimensions);
  };
  GearboxDesign whole = own_design(0), second = own_design(1);
  const SearchTrain& train = *pair.sets[0].train;
  const TrainKind* kind = find_train_kind(train.kind());
  TRUEFLANK_EXPECTS(kind);
  whole.topology = kind->topology(train.output, train.input);
  whole.losses = r.losses;
  whole.later_stages = {{.planets = second.planets,
                         .module_mm = second.module_mm,
                         .centre_distance_mm = second.centre_distance_mm}};
  for (GearDesign& gear : second.gears) whole.gears.push_back(std::move(gear));
  return whole;
}

StagePair carrying(const SearchRequirements& r, StagePair pair) {
  if (!r.output_torque_nm || !(r.face_width_max_mm || r.module_max_mm)) return pair;
  SearchRequirements own = stage_requirements(r, pair.sets[0]);
  double wanted = torque_before(r, pair);
  SearchCandidate& first = pair.candidates[0];
  // by the formula the drive's losses are not quite those told: once more with what is lacking
  for (int i = 0; i < 2; ++i) {
    own.output_torque_nm = wanted;
    const DesignValues values = design_values(own, SearchModel(own, pair.sets[0]), first.free,
                                              first.forward, first.backward);
    first.dimensions = values.dimensions;
    first.torque_nm = values.torque_nm;
    first.size_mm = values.size_mm;
    first.figures = values.figures;
    const auto train = lay_out(design_of_stages(r, pair));
    const double carried = train ? allowable_torque_nm(r, *train) : kNaN;
    if (!(carried > 0.0 && carried < *r.output_torque_nm)) break;
    wanted *= *r.output_torque_nm / carried;
  }
  return pair;
}

std::optional<StagePair> best_pair(const SearchRequirements& r, const std::array<ToothSet, 2>& sets,
                                   const std::array<std::vector<SearchCandidate>, 2>& designs) {
  std::optional<StagePair> best;
  double merit = kNaN;
  for (const SearchCandidate& first : designs[0])
    for (const SearchCandidate& second : designs[1]) {
      const StagePair pair{sets, {first, second}};
      const double here = composed_of_stages(r, pair).merit(r.objectives.front());
      if (best && !(here > merit)) continue;
      best = pair;
      merit = here;
    }
  if (best) best = carrying(r, *best);
  return best;
}

SearchCandidate evaluate_stages(const SearchRequirements& r, const StagePair& pair) {
  const SearchCandidate &first = pair.candidates[0], &second = pair.candidates[1];
  SearchCandidate whole{.free = first.free, .dimensions = first.dimensions};
  const ToldEfficiencies told = told_of(r, pair);
  whole.forward = told.forward;
  whole.backward = told.backward;
  whole.gap = first.gap + second.gap;
  whole.least_margin = std::min(first.least_margin, second.least_margin);
  whole.size_mm = std::max(first.size_mm, second.size_mm);
  whole.torque_nm = 0.0;
  const auto train = lay_out(design_of_stages(r, pair));
  if (!train) return whole;
  whole.torque_nm = allowable_torque_nm(r, *train);
  whole.figures = design_figures(r, *train, first.forward * second.forward,
                                 first.backward * second.backward, whole.torque_nm);
  if (!r.weights.empty())
    whole.score = weighted_score(
        r, told,
        {.torque_nm = whole.torque_nm, .size_mm = whole.size_mm, .figures = whole.figures});
  return whole;
}

SearchCandidate composed_of_stages(const SearchRequirements& r, const StagePair& pair) {
  const SearchCandidate &first = pair.candidates[0], &second = pair.candidates[1];
  const Growth growth = growth_for(r, torque_before(r, pair), first.torque_nm, r.module_mm);
  const double carries = growth.wider * growth.larger * growth.larger;
  SearchCandidate whole{.free = first.free};
  const ToldEfficiencies told = told_of(r, pair);
  whole.forward = told.forward;
  whole.backward = told.backward;
  whole.size_mm = std::max(first.size_mm * growth.larger, second.size_mm);
  whole.torque_nm =
      std::min(first.torque_nm * carries * std::abs(signed_ratio(pair.sets[1])) * second.forward,
               second.torque_nm);
  whole.figures.mass_kg = first.figures.mass_kg * carries + second.figures.mass_kg;
  whole.figures.length_mm = first.figures.length_mm * growth.wider + second.figures.length_mm +
                            GearboxDesign().layer_gap_mm;
  whole.figures.torque_density_nm_per_kg = whole.torque_nm / whole.figures.mass_kg;
  whole.figures.contact_ratio = std::min(first.figures.contact_ratio, second.figures.contact_ratio);
  whole.figures.sliding = std::max(first.figures.sliding, second.figures.sliding);
  if (!r.weights.empty())
    whole.score = weighted_score(
        r, told,
        {.torque_nm = whole.torque_nm, .size_mm = whole.size_mm, .figures = whole.figures});
  return whole;
}

bool may_keep(const FigureLimit& limit, const SearchCandidate& composed) {
  const double value = composed.value(limit.figure);
  if (limit.figure == SearchObjective::kMass || limit.figure == SearchObjective::kLength)
    return !(value > limit.value * kSlack);
  if (limit.figure == SearchObjective::kTorque) return !(value * kTorqueSlack < limit.value);
  return true;
}

bool is_of_stages(SearchObjective objective) {
  using enum SearchObjective;
  switch (objective) {
    case kStartingTorque:
    case kInputInertia:
    case kOutputInertia:
    case kBacklash:
    case kAcceleration:
    case kSettling:
      return false;
    default:
      return true;
  }
}

}  // namespace trueflank
