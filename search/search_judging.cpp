// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_judging.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/train/efficiency.h"

namespace trueflank {
namespace {

constexpr int kTightenings = 4;
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

  /// The designs of a set; none where no shifts keep the reserve.
  std::vector<SearchCandidate> optimised(const ToothSet& set, const LimitReserve& reserve) {
    SetResult result = optimise_set_or_stage(r_, set, reserve);
    report_.evaluations += result.evaluations;
    return std::move(result.candidates);
  }

  /// The set, or both stages, optimised with a reserve and judged.
  std::optional<Trial> tried(std::size_t set_index, const LimitReserve& reserve) {
    Trial trial{.reserve = reserve, .stages = stages_of(set_index)};
    if (trial.stages) {
      const auto& sets = trial.stages->sets;
      trial.stages =
          best_pair(r_, sets, {optimised(sets[0], reserve), optimised(sets[1], reserve)});
      if (!trial.stages) return std::nullopt;
      trial.candidate = evaluate_stages(r_, *trial.stages);
    } else {
      const auto designs = optimised(enumeration_.sets[set_index], reserve);
      if (designs.empty()) return std::nullopt;
      trial.candidate = designs.front();
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

}  // namespace

bool BetterCandidate::operator()(const RankedCandidate& p, const RankedCandidate& q) const {
  for (const SearchObjective objective : *objectives) {
    const double mp = p.candidate.merit(objective), mq = q.candidate.merit(objective);
    if (mp != mq) return mp > mq;
  }
  return p.set_index < q.set_index;
}

void judge_best(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                const DesignJudge& judge, SearchReport& report) {
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
}

}  // namespace trueflank
