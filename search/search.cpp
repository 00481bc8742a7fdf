// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/search/search_certify.h"
#include "trueflank/search/search_values.h"
#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

constexpr int kTightenings = 4;
/// So many times as many sets are listed where those listed do not do.
constexpr std::size_t kMoreListed = 4;
/// Designs of which is computed what their limits cost: each takes as long as a few tooth sets.
constexpr std::ptrdiff_t kRelaxed = 5;
/// Trains of two stages are listed up to this where all sets are.
constexpr std::size_t kMostPairs = 1000;
/// First extra distance from a limit a check found broken, in modules; so many times that each
/// time.
constexpr double kFirstTightening = 5e-5, kGrowth = 4.0;
/// Then the border of the check is sought, until a design that passes is at most this worse than
/// one that fails (of an efficiency; other objectives relatively).
constexpr double kShort = 1e-5;
constexpr int kRefinements = 10;

/// Limits whose reserve may mend a failed check.
std::vector<Limit> limits_behind(const std::string& check) {
  if (check == "overlap" || check == "tolerance" || check == "fillet_interference" ||
      check == "involute_interference")
    return {Limit::kFillet, Limit::kTrochoid};
  if (check == "trochoid_interference") return {Limit::kTrochoid};
  if (check == "contact_ratio") return {Limit::kContactRatio};
  if (check == "tip_clearance") return {Limit::kTipClearance};
  if (check == "tip_thickness") return {Limit::kTipThickness};
  if (check == "planet_spacing") return {Limit::kPlanetSpacing};
  return {};
}

bool dominates(const SearchCandidate& p, const SearchCandidate& q,
               const std::vector<SearchObjective>& objectives) {
  bool better = false;
  for (const SearchObjective objective : objectives) {
    if (p.merit(objective) < q.merit(objective)) return false;
    better = better || p.merit(objective) > q.merit(objective);
  }
  return better;
}

/// Best first by the first objective, then the others, then the set: a total order.
struct BetterCandidate {
  const std::vector<SearchObjective>* objectives;
  bool operator()(const RankedCandidate& p, const RankedCandidate& q) const {
    for (const SearchObjective objective : *objectives) {
      const double mp = p.candidate.merit(objective), mq = q.candidate.merit(objective);
      if (mp != mq) return mp > mq;
    }
    return p.set_index < q.set_index;
  }
};

void mark_front(std::vector<RankedCandidate>& ranking,
                const std::vector<SearchObjective>& objectives) {
  // best first by the first objective: only those before can dominate; the front so far suffices
  std::vector<const RankedCandidate*> front;
  for (RankedCandidate& candidate : ranking) {
    candidate.on_front = std::none_of(front.begin(), front.end(), [&](const RankedCandidate* f) {
      return dominates(f->candidate, candidate.candidate, objectives);
    });
    if (candidate.on_front) front.push_back(&candidate);
  }
}

/// Judges candidates, with more distance from their limits where a check asks for it.
class Judging {
 public:
  Judging(const SearchRequirements& requirements, const SetEnumeration& enumeration,
          const DesignJudge& judge, SearchReport& report)
      : r_(requirements), enumeration_(enumeration), judge_(judge), report_(report) {}

  /// The design where it passes as it is; otherwise a later place for its set in the ranking, where
  /// it passes with the least distance that mends it, or nothing where none does.
  std::optional<FoundDesign> judge(const RankedCandidate& ranked,
                                   std::optional<RankedCandidate>& again) {
    if (const auto known = mended_.find(ranked.set_index); known != mended_.end())
      return found(ranked, known->second);
    Trial trial{.candidate = ranked.candidate, .stages = stages_of(ranked.set_index)};
    if (judged(ranked.set_index, trial)) return found(ranked, trial);
    if (auto passing = mended(ranked.set_index, trial)) {
      again = RankedCandidate{ranked.set_index, passing->candidate, false};
      mended_.insert({ranked.set_index, std::move(*passing)});
    } else {
      count(trial.verdict.failed.front());
    }
    return std::nullopt;
  }

 private:
  /// The best of a set, or of a pair of stages, with a reserve, and what the checks say of it.
  struct Trial {
    LimitReserve reserve{};
    SearchCandidate candidate{};
    std::optional<StagePair> stages{};
    DesignVerdict verdict{};
  };

  /// The stages of a train in series, as ranked.
  [[nodiscard]] std::optional<StagePair> stages_of(std::size_t set_index) const {
    const std::size_t sets = enumeration_.sets.size();
    if (set_index < sets) return std::nullopt;
    return report_.pairs[set_index - sets];
  }

  [[nodiscard]] FoundDesign found(const RankedCandidate& ranked, const Trial& trial) const {
    FoundDesign found{
        .set_index = ranked.set_index,
        .set = trial.stages ? trial.stages->sets[0] : ToothSet(enumeration_.sets[ranked.set_index]),
        .stages = trial.stages,
        .candidate = ranked.candidate,
        .design = design_of(ranked.set_index, trial),
        .verdict = trial.verdict,
        .reserve = trial.reserve};
    const EfficiencyResult exact =
        trueflank::efficiency(*lay_out(found.design), {.model = LossModel::kPathIntegral});
    found.exact_forward = exact.forward;
    found.exact_backward = exact.backward;
    found.by_formula = exact.by_formula;
    return found;
  }

  [[nodiscard]] GearboxDesign design_of(std::size_t set_index, const Trial& trial) const {
    if (trial.stages) return design_of_stages(r_, *trial.stages);
    return SearchModel(r_, enumeration_.sets[set_index])
        .design(trial.candidate.free, trial.candidate.dimensions);
  }

  /// Whether it passes.
  bool judged(std::size_t set_index, Trial& trial) {
    ++report_.judged;
    const auto train = lay_out(design_of(set_index, trial));
    if (!train)
      trial.verdict.failed = {"layout"};
    else if (judge_)
      trial.verdict = judge_(*train);
    return trial.verdict.failed.empty();
  }

  /// The best of a set; nothing where no shifts keep the reserve.
  std::optional<SearchCandidate> optimised(const ToothSet& set, const LimitReserve& reserve) {
    SetResult result = optimise_set_or_stage(r_, set, reserve);
    report_.evaluations += result.evaluations;
    if (result.candidates.empty()) return std::nullopt;
    return std::move(result.candidates.front());
  }

  /// The set, or both stages, optimised with a reserve and judged.
  std::optional<Trial> tried(std::size_t set_index, const LimitReserve& reserve) {
    Trial trial{.reserve = reserve, .stages = stages_of(set_index)};
    if (trial.stages) {
      for (std::size_t stage = 0; stage < 2; ++stage) {
        const auto best = optimised(trial.stages->sets[stage], reserve);
        if (!best) return std::nullopt;
        trial.stages->candidates[stage] = *best;
      }
      trial.candidate = evaluate_stages(r_, *trial.stages);
    } else {
      const auto best = optimised(enumeration_.sets[set_index], reserve);
      if (!best) return std::nullopt;
      trial.candidate = *best;
    }
    judged(set_index, trial);
    return trial;
  }

  /// From a failed trial to one that passes and is as good, but for kShort, as one that fails.
  std::optional<Trial> mended(std::size_t set_index, Trial failed) {
    if (r_.objectives.size() > 1) return std::nullopt;
    std::optional<Trial> passing;
    for (int i = 0; i < kTightenings && !passing; ++i) {
      const auto reserve = farther(failed);
      if (!reserve) return std::nullopt;
      auto next = tried(set_index, *reserve);
      if (!next) return std::nullopt;
      if (next->verdict.failed.empty())
        passing = std::move(next);
      else
        failed = std::move(*next);
    }
    for (int i = 0; passing && i < kRefinements && is_short(*passing, failed); ++i) {
      auto next = tried(set_index, between(failed.reserve, passing->reserve));
      if (!next) break;
      (next->verdict.failed.empty() ? *passing : failed) = std::move(*next);
    }
    return passing;
  }

  [[nodiscard]] bool is_short(const Trial& passing, const Trial& failed) const {
    const SearchObjective objective = r_.objectives.front();
    const double merit = passing.candidate.merit(objective);
    return failed.candidate.merit(objective) - merit > kShort * std::max(1.0, std::abs(merit));
  }

  /// More distance from the limits behind the checks that failed; nothing where there are none.
  static std::optional<LimitReserve> farther(const Trial& failed) {
    LimitReserve reserve = failed.reserve;
    for (const std::string& check : failed.verdict.failed)
      for (const Limit limit : limits_behind(check)) {
        const auto index = static_cast<std::size_t>(limit);
        reserve[index] =
            failed.reserve[index] == 0.0 ? kFirstTightening : kGrowth * failed.reserve[index];
      }
    if (reserve == failed.reserve) return std::nullopt;
    return reserve;
  }

  static LimitReserve between(const LimitReserve& low, const LimitReserve& high) {
    LimitReserve reserve{};
    for (std::size_t i = 0; i < reserve.size(); ++i)
      reserve[i] = low[i] == 0.0 ? high[i] / kGrowth : std::sqrt(low[i] * high[i]);
    return reserve;
  }

  void count(const std::string& check) {
    for (SetClass& c : report_.fell_in_checks)
      if (c.id == check) {
        ++c.count;
        return;
      }
    report_.fell_in_checks.push_back({check, "fails the check and no distance mends it", 1});
  }

  const SearchRequirements& r_;
  const SetEnumeration& enumeration_;
  const DesignJudge& judge_;
  SearchReport& report_;
  std::map<std::size_t, Trial> mended_;  ///< by set
};

/// The best trains of two stages, as many as sets are listed.
StagePairs pairs_of(const SearchRequirements& r, const SetEnumeration& enumeration) {
  if (enumeration.stages.empty()) return {};
  return best_stage_pairs(
      r, enumeration.stages,
      r.listed > 0 ? static_cast<std::size_t>(std::max(r.listed, r.results)) : kMostPairs);
}

void count_records(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                   const SearchRecords& records, const std::vector<RankedPair>& pairs,
                   SearchReport& report) {
  report.considered = enumeration.considered;
  report.classes = enumeration.rejected;
  report.sets = enumeration.sets.size();
  report.optimised = records.sets();
  report.passed_over = records.passed_over;
  std::map<std::string, SetClass> by_limit;
  for (const SearchRecord& record : records.optimised) {
    report.evaluations += record.result.evaluations;
    for (const SearchCandidate& candidate : record.result.candidates)
      report.ranking.push_back({record.index, candidate, false});
    if (!record.result.candidates.empty()) {
      ++report.feasible;
      continue;
    }
    SetClass c{"limits", "no shifts found that keep all limits", 0};
    if (record.result.failed_limit >= static_cast<int>(kLimits)) {
      const auto index = static_cast<std::size_t>(record.result.failed_limit) - kLimits;
      const SearchObjective figure = asked_limits(requirements)[index].figure;
      c = {to_text(figure), "no shifts keep the limit of this figure", 0};
      if (figure == SearchObjective::kTorque)
        c.description = "no shifts carry the output torque asked for";
    } else if (record.result.failed_limit >= 0) {
      const LimitEntry& entry =
          enumeration.sets[record.index]
              .train->limits[static_cast<std::size_t>(record.result.failed_limit)];
      c.id = std::string(to_text(entry.limit)) + ":" + entry.where;
      c.description = "no shifts keep this limit together with the others";
    }
    by_limit.try_emplace(c.id, c).first->second.count++;
  }
  for (const auto& [id, c] : by_limit) report.classes.push_back(c);
  if (records.passed_over > 0)
    report.classes.push_back({"not_listed", "no better than the last one listed, or none at all",
                              static_cast<long long>(records.passed_over)});
  if (!enumeration.stages.empty())
    report.classes.push_back({"stages", "stages of trains in series, put together in pairs",
                              static_cast<long long>(enumeration.stages.size())});
  for (const RankedPair& ranked : pairs) {
    report.ranking.push_back({enumeration.sets.size() + report.pairs.size(), ranked.whole, false});
    report.pairs.push_back(ranked.pair);
  }
  std::sort(report.ranking.begin(), report.ranking.end(),
            BetterCandidate{&requirements.objectives});
  mark_front(report.ranking, requirements.objectives);
}

}  // namespace

namespace {

SearchReport judged(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                    const SearchRecords& records, const StagePairs& pairs,
                    const DesignJudge& judge) {
  SearchReport report;
  count_records(requirements, enumeration, records, pairs.best, report);
  report.evaluations += pairs.evaluations;
  const BetterCandidate better{&requirements.objectives};
  std::vector<RankedCandidate> queue;
  for (const RankedCandidate& candidate : report.ranking)
    if (requirements.objectives.size() == 1 || candidate.on_front) queue.push_back(candidate);
  Judging judging(requirements, enumeration, judge, report);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (report.designs.size() >= static_cast<std::size_t>(requirements.results)) break;
    std::optional<RankedCandidate> again;
    if (auto found = judging.judge(queue[i], again)) {
      report.designs.push_back(std::move(*found));
    } else if (again) {
      const auto from = queue.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      queue.insert(std::upper_bound(from, queue.end(), *again, better), *again);
    }
  }
  return report;
}

/// Whether sets that were passed over might be better than a design that is reported: they can be
/// as good as the last one listed.
bool might_lack_one(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                    const SearchReport& report) {
  if (report.passed_over == 0) return false;
  if (report.designs.size() < static_cast<std::size_t>(requirements.results)) return true;
  const SearchObjective objective = requirements.objectives.front();
  const auto last = std::find_if(
      report.ranking.rbegin(), report.ranking.rend(),
      [&](const RankedCandidate& c) { return c.set_index < enumeration.sets.size(); });
  return std::any_of(report.designs.begin(), report.designs.end(), [&](const FoundDesign& found) {
    return found.candidate.merit(objective) < last->candidate.merit(objective);
  });
}

/// No shifts of a set give its meshes a higher efficiency.
double bound_of_meshes(const SearchRequirements& r, const ToothSet& set, const FreeShifts& free,
                       DriveDirection direction) {
  const SearchModel model(r, set);
  const double known =
      model.efficiency(model.layer1(free.centre_distance, free.layer1_shift),
                       model.layer2(free.centre_distance, free.layer2_shift), direction);
  return certified_bound(r, set, direction, {.known = known}).efficiency;
}

/// How much better the shifts of a design could be at most.
void certify(const SearchRequirements& r, FoundDesign& found) {
  const SearchObjective objective = r.objectives.front();
  const bool forward = objective == SearchObjective::kForward;
  if (r.objectives.size() > 1 || (!forward && objective != SearchObjective::kBackward)) return;
  const DriveDirection direction = forward ? DriveDirection::kForward : DriveDirection::kBackward;
  double bound = 1.0, ratio = signed_ratio(found.set);
  if (found.stages) {
    ratio = signed_ratio(*found.stages);
    for (std::size_t stage = 0; stage < 2; ++stage) {
      const ToothSet& set = found.stages->sets[stage];
      bound *= bound_of_meshes(stage_requirements(r, set), set,
                               found.stages->candidates[stage].free, direction);
    }
  } else {
    bound = bound_of_meshes(r, found.set, found.candidate.free, direction);
  }
  const ToldEfficiencies told = told_efficiencies(r, ratio, bound, bound);
  found.certified_bound = forward ? told.forward : told.backward;
  found.certified_gap = std::max(0.0, found.certified_bound - found.candidate.merit(objective));
}

/// Of a train in series each stage's, with what the whole's first objective would be.
std::vector<BindingLimit> binding_of(const SearchRequirements& r, const FoundDesign& found,
                                     bool costs) {
  if (!found.stages) return binding_limits(r, found.set, found.candidate, found.reserve, costs);
  const SearchObjective objective = r.objectives.front();
  std::vector<BindingLimit> all;
  for (std::size_t stage = 0; stage < 2; ++stage) {
    const ToothSet& set = found.stages->sets[stage];
    const double other = found.stages->candidates[1 - stage].value(objective);
    for (BindingLimit& b : binding_limits(stage_requirements(r, set), set,
                                          found.stages->candidates[stage], found.reserve, costs)) {
      b.objective = r.losses ? kNaN : b.objective * other;
      all.push_back(std::move(b));
    }
  }
  return all;
}

}  // namespace

SearchReport conclude_search(const SearchRequirements& requirements,
                             const SetEnumeration& enumeration, const SearchRecords& records,
                             const DesignJudge& judge) {
  const StagePairs pairs = pairs_of(requirements, enumeration);
  SearchReport report = judged(requirements, enumeration, records, pairs, judge);
  SearchRequirements wider = requirements;
  SearchRecords more;
  while (might_lack_one(requirements, enumeration, report)) {
    wider.listed = static_cast<int>(kMoreListed * listed_sets(wider));
    more = run_search(wider, enumeration,
                      {.done = more.optimised.empty() ? records.optimised : more.optimised});
    report = judged(requirements, enumeration, more, pairs, judge);
  }
  for (FoundDesign& found : report.designs) certify(requirements, found);
  for (FoundDesign& found : report.designs)
    found.binding =
        binding_of(requirements, found, &found - report.designs.data() < kRelaxed);
  if (!report.designs.empty() && !report.designs.front().stages)
    report.binding_ranges =
        binding_ranges(requirements, report.designs.front().set, report.designs.front().candidate);
  return report;
}

double FoundDesign::tightened() const { return *std::max_element(reserve.begin(), reserve.end()); }

}  // namespace trueflank
