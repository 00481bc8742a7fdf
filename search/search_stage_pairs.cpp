// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_stage_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "trueflank/base/threads.h"
#include "trueflank/search/search_bound.h"
#include "trueflank/search/search_listing.h"
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

/// Stages looked at together, whatever the number of threads, and pairs they are chosen from: where
/// a bound can pass over some, no more than are listed.
constexpr std::size_t kStagesAtOnce = 32, kPairsAtOnce = 128;
/// Pairs that are kept before those no longer listed are left out.
constexpr std::size_t kPairsKept = 100000;

bool ratio_in_range(const SearchRequirements& r, double ratio) {
  if (r.direction == OutputDirection::kSame && ratio < 0.0) return false;
  if (r.direction == OutputDirection::kOpposite && ratio > 0.0) return false;
  return std::abs(ratio) >= r.ratio_min && std::abs(ratio) <= r.ratio_max;
}

bool keeps(const FigureLimit& limit, const SearchCandidate& whole) {
  return merit_of_figure(limit.figure, whole.value(limit.figure)) >=
         merit_of_figure(limit.figure, limit.value);
}

/// A tooth set of a stage: bounded closer and closer, then optimised.
class Stage {
 public:
  Stage(const SearchRequirements& r, const ToothSet& set, std::size_t index)
      : set_(set), ratio_(trueflank::signed_ratio(set)) {
    record_.index = index;
    const SearchRequirements own = stage_requirements(r, set);
    if (has_bounds(r)) size_mm_ = least_size_mm(own, set);
  }

  [[nodiscard]] const ToothSet& set() const { return set_; }
  [[nodiscard]] double ratio() const { return ratio_; }
  /// Of the meshes forward, backward: what they do not exceed; below 0 where they cannot be.
  [[nodiscard]] const MeshBounds& meshes() const { return meshes_; }
  [[nodiscard]] double least_size() const { return size_mm_; }
  [[nodiscard]] bool known() const { return step_ == Step::kOptimised; }
  [[nodiscard]] bool possible() const {
    return known() ? !candidates().empty() : meshes_.possible();
  }
  [[nodiscard]] const SearchRecord& record() const { return record_; }
  [[nodiscard]] const std::vector<SearchCandidate>& candidates() const {
    return record_.result.candidates;
  }

  void take(const SearchRecord& done) {
    record_ = done;
    step_ = Step::kOptimised;
    know_meshes();
  }
  void bound_first(const SearchRequirements& r) {
    if (step_ != Step::kNothing) return;
    meshes_.lower(stage_requirements(r, set_), set_, BoundBy::kProfiles);
    step_ = Step::kProfiles;
  }
  /// A step further. Halving is worth it where a bound can pass over pairs.
  void go_on(const SearchRequirements& r) {
    const SearchRequirements own = stage_requirements(r, set_);
    if (step_ == Step::kProfiles && has_bounds(r)) {
      meshes_.lower(own, set_, BoundBy::kHalving);
      step_ = Step::kHalved;
      return;
    }
    record_.result = optimise_set(own, set_);
    step_ = Step::kOptimised;
    know_meshes();
  }

 private:
  enum class Step { kNothing, kProfiles, kHalved, kOptimised };

  void know_meshes() {
    if (candidates().empty()) return;
    meshes_ = {.forward = 0.0, .backward = 0.0};
    for (const SearchCandidate& c : candidates()) {
      meshes_.forward = std::max(meshes_.forward, c.forward);
      meshes_.backward = std::max(meshes_.backward, c.backward);
    }
  }

  ToothSet set_;
  double ratio_;
  MeshBounds meshes_;
  double size_mm_ = 0.0;
  Step step_ = Step::kNothing;
  SearchRecord record_;
};

class Pairing {
 public:
  Pairing(const SearchRequirements& r, const std::vector<ToothSet>& sets,
          const std::vector<SearchRecord>& done, std::size_t listed, const SearchPart& part)
      : r_(r),
        part_(part),
        listing_(listed),
        listed_(listed),
        limits_(asked_limits(r)),
        pairs_at_once_(has_bounds(r) ? std::clamp<std::size_t>(listed, 1, kPairsAtOnce)
                                     : kPairsAtOnce) {
    for (const ToothSet& set : sets) stages_.emplace_back(r, set, stages_.size());
    for (const SearchRecord& record : done) {
      stages_[record.index].take(record);
      combine_with_known(record.index);
      known_.push_back(record.index);
    }
  }

  bool run(const StageRunOptions& options);
  [[nodiscard]] std::vector<SearchRecord> records() const;
  [[nodiscard]] std::vector<RankedPair> pairs();

 private:
  struct Rated {
    double promise = 0.0;
    std::size_t first = 0, second = 0;
    /// The better one first: a total order.
    bool operator<(const Rated& o) const {
      return std::tie(o.promise, first, second) < std::tie(promise, o.first, o.second);
    }
  };

  [[nodiscard]] double promise(std::size_t stage) const {
    return r_.objectives.front() == SearchObjective::kBackward ? stages_[stage].meshes().backward
                                                               : stages_[stage].meshes().forward;
  }
  [[nodiscard]] std::vector<std::size_t> promising(int number) const;
  [[nodiscard]] std::vector<std::size_t> open_stages() const;
  [[nodiscard]] bool excluded(std::size_t first, std::size_t second) const;
  bool take_steps(const std::vector<std::size_t>& open, const StageRunOptions& options,
                  const std::function<void(Stage&)>& step);
  void combine_with_known(std::size_t stage);
  void combine(std::size_t first, std::size_t second);
  [[nodiscard]] bool keeps_limits(const StagePair& pair, const SearchCandidate& composed) const;
  void forget_excluded();

  const SearchRequirements& r_;
  SearchPart part_;
  Listing listing_;
  std::size_t listed_;
  std::vector<FigureLimit> limits_;
  std::size_t pairs_at_once_;
  std::vector<Stage> stages_;
  std::vector<std::size_t> known_;
  std::vector<RankedPair> pairs_;  ///< `whole` as put together from the stages
};

/// Those of one number that can be, the best first.
std::vector<std::size_t> Pairing::promising(int number) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < stages_.size(); ++i)
    if (stages_[i].set().train->stage == number && stages_[i].possible() &&
        (number == 2 || part_.holds(i)))
      found.push_back(i);
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t p, std::size_t q) { return promise(p) > promise(q); });
  return found;
}

bool Pairing::excluded(std::size_t first, std::size_t second) const {
  const Stage &p = stages_[first], &q = stages_[second];
  const MeshBounds meshes{.forward = p.meshes().forward * q.meshes().forward,
                          .backward = p.meshes().backward * q.meshes().backward};
  return listing_.excludes(
      merit_bounds(r_, p.ratio() * q.ratio(), meshes, std::max(p.least_size(), q.least_size())));
}

/// Stages of the most promising pairs of which it is not known yet whether they are listed.
std::vector<std::size_t> Pairing::open_stages() const {
  const std::vector<std::size_t> firsts = promising(1), seconds = promising(2);
  std::vector<Rated> heap;  // the worst on top
  for (const std::size_t first : firsts)
    for (const std::size_t second : seconds) {
      const Rated rated{promise(first) * promise(second), first, second};
      const bool full = heap.size() == pairs_at_once_;
      if (full && rated.promise < heap.front().promise) break;
      if (stages_[first].known() && stages_[second].known()) continue;
      if (full && !(rated < heap.front())) continue;
      if (!ratio_in_range(r_, stages_[first].ratio() * stages_[second].ratio()) ||
          excluded(first, second))
        continue;
      heap.push_back(rated);
      std::push_heap(heap.begin(), heap.end());
      if (heap.size() > pairs_at_once_) std::pop_heap(heap.begin(), heap.end()), heap.pop_back();
    }
  std::sort_heap(heap.begin(), heap.end());
  std::vector<std::size_t> open;
  for (const Rated& rated : heap)
    for (const std::size_t stage : {rated.first, rated.second})
      if (open.size() < kStagesAtOnce && !stages_[stage].known() &&
          std::find(open.begin(), open.end(), stage) == open.end())
        open.push_back(stage);
  return open;
}

/// False where it was stopped; what was begun is finished.
bool Pairing::take_steps(const std::vector<std::size_t>& open, const StageRunOptions& options,
                         const std::function<void(Stage&)>& step) {
  const auto stopped = [&] { return options.stop && options.stop->load(); };
  std::atomic<std::size_t> next{0};
  for_each_piece(std::min(open.size(), options.threads), [&](std::size_t) {
    while (!stopped()) {
      const std::size_t i = next++;
      if (i >= open.size()) return;
      step(stages_[open[i]]);
    }
  });
  return next >= open.size();
}

bool Pairing::run(const StageRunOptions& options) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < stages_.size(); ++i) all.push_back(i);
  if (!take_steps(all, options, [&](Stage& stage) { stage.bound_first(r_); })) return false;
  while (true) {
    const std::vector<std::size_t> open = open_stages();
    if (open.empty()) return true;
    const bool all_done = take_steps(open, options, [&](Stage& stage) { stage.go_on(r_); });
    for (const std::size_t stage : open) {
      if (!stages_[stage].known()) continue;
      combine_with_known(stage);
      known_.push_back(stage);
      if (options.on_record) options.on_record(stages_[stage].record());
    }
    if (!all_done) return false;
  }
}

void Pairing::combine_with_known(std::size_t stage) {
  if (stages_[stage].candidates().empty()) return;
  const bool is_first = stages_[stage].set().train->stage == 1;
  for (const std::size_t other : known_) {
    if ((stages_[other].set().train->stage == 1) == is_first) continue;
    combine(is_first ? stage : other, is_first ? other : stage);
  }
  if (pairs_.size() > kPairsKept) forget_excluded();
}

/// Every design of one stage with every design of the other.
void Pairing::combine(std::size_t first, std::size_t second) {
  const Stage &p = stages_[first], &q = stages_[second];
  if (!part_.holds(first) || !ratio_in_range(r_, p.ratio() * q.ratio())) return;
  std::vector<RankedPair> own;
  for (const SearchCandidate& one : p.candidates())
    for (const SearchCandidate& other : q.candidates()) {
      RankedPair ranked{{first, second}, {{p.set(), q.set()}, {one, other}}, {}};
      ranked.whole = composed_of_stages(r_, ranked.pair);
      const Merits merits = merits_of(ranked.whole, r_.objectives);
      const bool beaten = listing_.excludes(merits) ||
                          std::any_of(own.begin(), own.end(), [&](const RankedPair& o) {
                            return dominates(merits_of(o.whole, r_.objectives), merits);
                          });
      if (!beaten && keeps_limits(ranked.pair, ranked.whole)) own.push_back(std::move(ranked));
    }
  std::vector<Merits> designs;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Merits merits = merits_of(own[i].whole, r_.objectives);
    if (std::any_of(own.begin() + static_cast<std::ptrdiff_t>(i), own.end(),
                    [&](const RankedPair& o) {
                      return dominates(merits_of(o.whole, r_.objectives), merits);
                    }))
      continue;
    designs.push_back(merits);
    pairs_.push_back(own[i]);
  }
  listing_.add(std::move(designs));
}

bool Pairing::keeps_limits(const StagePair& pair, const SearchCandidate& composed) const {
  if (limits_.empty()) return true;
  if (!std::all_of(limits_.begin(), limits_.end(),
                   [&](const FigureLimit& limit) { return may_keep(limit, composed); }))
    return false;
  const SearchCandidate whole = evaluate_stages(r_, carrying(r_, pair));
  return std::all_of(limits_.begin(), limits_.end(),
                     [&](const FigureLimit& limit) { return keeps(limit, whole); });
}

void Pairing::forget_excluded() {
  std::erase_if(pairs_, [&](const RankedPair& ranked) {
    return listing_.excludes(merits_of(ranked.whole, r_.objectives));
  });
}

std::vector<SearchRecord> Pairing::records() const {
  std::vector<SearchRecord> found;
  for (const Stage& stage : stages_)
    if (stage.known()) found.push_back(stage.record());
  return found;
}

std::vector<RankedPair> Pairing::pairs() {
  forget_excluded();
  const SearchObjective objective = r_.objectives.front();
  std::stable_sort(pairs_.begin(), pairs_.end(), [&](const RankedPair& p, const RankedPair& q) {
    const double mp = p.whole.merit(objective), mq = q.whole.merit(objective);
    return mp != mq ? mp > mq : p.stages < q.stages;
  });
  if (r_.objectives.size() == 1 && pairs_.size() > listed_) pairs_.resize(listed_);
  return std::move(pairs_);
}

}  // namespace

StageRun run_stages(const SearchRequirements& r, const std::vector<ToothSet>& stages,
                    const StageRunOptions& options) {
  Pairing pairing(r, stages, options.done, options.listed, options.part);
  const bool done = pairing.run(options);
  return {.stages = pairing.records(), .stopped = !done};
}

std::vector<RankedPair> best_stage_pairs(const SearchRequirements& r,
                                         const std::vector<ToothSet>& stages,
                                         const std::vector<SearchRecord>& optimised,
                                         std::size_t listed) {
  std::vector<RankedPair> pairs = Pairing(r, stages, optimised, listed, {}).pairs();
  for (RankedPair& ranked : pairs) {
    ranked.pair = carrying(r, std::move(ranked.pair));
    ranked.whole = evaluate_stages(r, ranked.pair);
  }
  return pairs;
}

std::vector<SearchRecord> stages_of_best_pairs(const SearchRequirements& r,
                                               const std::vector<ToothSet>& stages,
                                               const std::vector<SearchRecord>& optimised,
                                               std::size_t listed, const SearchPart& part) {
  std::set<std::size_t> needed;
  for (const RankedPair& ranked : Pairing(r, stages, optimised, listed, part).pairs())
    needed.insert(ranked.stages.begin(), ranked.stages.end());
  std::vector<SearchRecord> found;
  for (const SearchRecord& record : optimised)
    if (needed.contains(record.index)) found.push_back(record);
  return found;
}

}  // namespace trueflank
