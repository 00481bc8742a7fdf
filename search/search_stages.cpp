// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_stages.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/search/search_bound.h"
#include "trueflank/search/search_values.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

/// Figures of a whole are at least (most) those of its stages, but for rounding.
constexpr double kSlack = 1.0 + 1e-6;
/// Allowable torque of a whole against the first stage's times ratio and efficiency behind it.
constexpr double kTorqueSlack = 1.05;
/// Stages looked at together, whatever the number of threads.
constexpr std::size_t kStagesAtOnce = 32;

bool is_of_each_stage(SearchObjective figure) {
  return figure == SearchObjective::kSize || figure == SearchObjective::kContactRatio ||
         figure == SearchObjective::kSliding;
}

ToldEfficiencies told_of(const SearchRequirements& r, const StagePair& pair) {
  const auto &first = pair.candidates[0], &second = pair.candidates[1];
  return told_efficiencies(r, signed_ratio(pair), first.forward * second.forward,
                           first.backward * second.backward);
}

bool ratio_fits(const SearchRequirements& r, double ratio) {
  if (r.direction == OutputDirection::kSame && ratio < 0.0) return false;
  if (r.direction == OutputDirection::kOpposite && ratio > 0.0) return false;
  return std::abs(ratio) >= r.ratio_min && std::abs(ratio) <= r.ratio_max;
}

/// Cheap, and never wrong: what the stages alone say of a limit on the whole.
bool may_keep(const FigureLimit& limit, const StagePair& pair) {
  const SearchCandidate &first = pair.candidates[0], &second = pair.candidates[1];
  const double a = first.value(limit.figure), b = second.value(limit.figure);
  if (limit.figure == SearchObjective::kMass || limit.figure == SearchObjective::kLength)
    return !(a + b > limit.value * kSlack);
  if (limit.figure == SearchObjective::kTorque)
    return !(a * std::abs(signed_ratio(pair.sets[1])) * kTorqueSlack < limit.value ||
             b * kSlack < limit.value);
  return true;
}

bool keeps(const FigureLimit& limit, const SearchCandidate& whole) {
  return merit_of_figure(limit.figure, whole.value(limit.figure)) >=
         merit_of_figure(limit.figure, limit.value);
}

/// A tooth set of a stage: bounded closer and closer, then optimised.
class Stage {
 public:
  explicit Stage(const ToothSet& set) : set_(set) {}

  [[nodiscard]] const ToothSet& set() const { return set_; }
  /// Of the meshes: what it is, or what it does not exceed; below 0 where it cannot be.
  [[nodiscard]] double merit() const { return merit_; }
  [[nodiscard]] bool known() const { return step_ == Step::kOptimised; }
  [[nodiscard]] const SearchCandidate& candidate() const { return candidate_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

  void go_on(const SearchRequirements& r) {
    const SearchRequirements own = stage_requirements(r, set_);
    const SearchObjective objective = r.objectives.front();
    const DriveDirection direction = objective == SearchObjective::kForward
                                         ? DriveDirection::kForward
                                         : DriveDirection::kBackward;
    if (step_ == Step::kNothing) {
      merit_ = efficiency_bound(own, set_, direction, BoundBy::kProfiles);
      step_ = Step::kProfiles;
    } else if (step_ == Step::kProfiles) {
      merit_ = std::min(merit_, efficiency_bound(own, set_, direction, BoundBy::kHalving));
      step_ = Step::kHalved;
    } else if (step_ == Step::kHalved) {
      const SetResult result = optimise_set(own, set_);
      evaluations_ = result.evaluations;
      merit_ = result.candidates.empty() ? -1.0 : result.candidates.front().merit(objective);
      if (!result.candidates.empty()) candidate_ = result.candidates.front();
      step_ = Step::kOptimised;
    }
  }

 private:
  enum class Step { kNothing, kProfiles, kHalved, kOptimised };
  ToothSet set_;
  double merit_ = 1.0;
  Step step_ = Step::kNothing;
  SearchCandidate candidate_;
  int evaluations_ = 0;
};

using Stages = std::vector<Stage*>;

/// Those of one number that can be, the best first.
Stages sorted_stages(std::vector<Stage>& all, int number) {
  Stages stages;
  for (Stage& stage : all)
    if (stage.set().train->stage == number && stage.merit() >= 0.0) stages.push_back(&stage);
  std::stable_sort(stages.begin(), stages.end(),
                   [](const Stage* p, const Stage* q) { return p->merit() > q->merit(); });
  return stages;
}

StagePair pair_of(const Stage& first, const Stage& second) {
  return {{first.set(), second.set()}, {first.candidate(), second.candidate()}};
}

struct RatedPair {
  double merit = 0.0;
  Stage *first = nullptr, *second = nullptr;  ///< in one array
  /// The better one first: a total order.
  bool operator<(const RatedPair& o) const {
    if (merit != o.merit) return merit > o.merit;
    return first != o.first ? first < o.first : second < o.second;
  }
};

/// The best pairs by what is known, `most` of them.
std::vector<RatedPair> rated_pairs(const SearchRequirements& r, std::vector<Stage>& all,
                                   std::size_t most) {
  const Stages firsts = sorted_stages(all, 1), seconds = sorted_stages(all, 2);
  const std::vector<FigureLimit> limits = asked_limits(r);
  const bool forward = r.objectives.front() == SearchObjective::kForward;
  std::vector<RatedPair> heap;  // the worst on top
  for (Stage* first : firsts)
    for (Stage* second : seconds) {
      const bool full = heap.size() == most;
      const double product = first->merit() * second->merit();
      // without losses a pair is worth the product, and what follows is worth less
      if (full && !r.losses && product < heap.front().merit) break;
      const double ratio = signed_ratio(first->set()) * signed_ratio(second->set());
      if (!ratio_fits(r, ratio)) continue;
      const ToldEfficiencies told = told_efficiencies(r, ratio, product, product);
      const RatedPair rated{forward ? told.forward : told.backward, first, second};
      if (full && !(rated < heap.front())) continue;
      if (first->known() && second->known()) {
        const StagePair pair = pair_of(*first, *second);
        if (!std::all_of(limits.begin(), limits.end(),
                         [&](const FigureLimit& limit) { return may_keep(limit, pair); }))
          continue;
      }
      heap.push_back(rated);
      std::push_heap(heap.begin(), heap.end());
      if (heap.size() > most) std::pop_heap(heap.begin(), heap.end()), heap.pop_back();
    }
  std::sort_heap(heap.begin(), heap.end());
  return heap;
}

/// The best pairs, all of optimised stages.
std::vector<RatedPair> optimised_pairs(const SearchRequirements& r, std::vector<Stage>& all,
                                       std::size_t most) {
  while (true) {
    std::vector<RatedPair> rated = rated_pairs(r, all, most);
    std::vector<Stage*> open;  // of the best first: what they are worth decides about the others
    for (const RatedPair& pair : rated)
      for (Stage* stage : {pair.first, pair.second})
        if (open.size() < kStagesAtOnce && !stage->known() &&
            std::find(open.begin(), open.end(), stage) == open.end())
          open.push_back(stage);
    if (open.empty()) return rated;
    for_each_piece(open.size(), [&](std::size_t i) { open[i]->go_on(r); });
  }
}

}  // namespace

SearchRequirements stage_requirements(const SearchRequirements& r, const ToothSet& set) {
  SearchRequirements own = r;
  const int stage = set.train->stage;
  if (stage == 0) return own;
  own.losses.reset();
  std::erase_if(own.figure_limits,
                [](const FigureLimit& limit) { return !is_of_each_stage(limit.figure); });
  if (!r.outer_diameter_mm) {
    own.backlash_mm = r.backlash_mm.value_or(kUsualBacklash * r.module_mm);
    own.module_mm = r.module_mm * set.layer2_module_ratio;
  }
  if (stage == 1) {
    own.output_torque_nm.reset();
    own.face_width_max_mm.reset();
  }
  own.module_max_mm.reset();
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

SearchCandidate evaluate_stages(const SearchRequirements& r, const StagePair& pair) {
  const SearchCandidate &first = pair.candidates[0], &second = pair.candidates[1];
  SearchCandidate whole{.free = first.free};
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
  return whole;
}

StagePairs best_stage_pairs(const SearchRequirements& r, const std::vector<ToothSet>& sets,
                            std::size_t count) {
  std::vector<Stage> all(sets.begin(), sets.end());
  for_each_piece(all.size(), [&](std::size_t i) { all[i].go_on(r); });
  const std::vector<FigureLimit> limits = asked_limits(r);
  StagePairs result;
  for (std::size_t most = count;; most *= 4) {
    const std::vector<RatedPair> rated = optimised_pairs(r, all, most);
    result.best.clear();
    for (const RatedPair& one : rated) {
      if (result.best.size() == count) break;
      RankedPair ranked{pair_of(*one.first, *one.second), {}};
      ranked.whole = evaluate_stages(r, ranked.pair);
      if (std::all_of(limits.begin(), limits.end(),
                      [&](const FigureLimit& limit) { return keeps(limit, ranked.whole); }))
        result.best.push_back(std::move(ranked));
    }
    if (result.best.size() == count || rated.size() < most) break;
  }
  for (const Stage& stage : all) {
    result.optimised += stage.known();
    result.evaluations += stage.evaluations();
  }
  return result;
}

}  // namespace trueflank
