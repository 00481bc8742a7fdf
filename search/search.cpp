// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <algorithm>
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
/// First extra distance from a limit a check found broken, in modules; four times that each time.
constexpr double kFirstTightening = 5e-5;

/// Limits whose reserve may mend a failed check.
std::vector<Limit> limits_behind(const std::string& check) {
  if (check == "overlap" || check == "tolerance" || check == "fillet_interference" || check == "involute_interference")
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

/// Judges one candidate, with more distance from its limits where a check asks for it.
class Judging {
 public:
  Judging(const SearchRequirements& requirements, const SetEnumeration& enumeration,
          const DesignJudge& judge, SearchReport& report)
      : r_(requirements), enumeration_(enumeration), judge_(judge), report_(report) {}

  /// The design where it passes as it is; otherwise a later place for its set in the ranking, or
  /// nothing where no distance mends it.
  std::optional<FoundDesign> judge(const RankedCandidate& ranked,
                                   std::optional<RankedCandidate>& again) {
    const ToothSet set = enumeration_.sets[ranked.set_index];
    const SearchModel model(r_, set);
    FoundDesign found{
        .set_index = ranked.set_index,
        .set = set, .candidate = ranked.candidate,
        .design = model.design(ranked.candidate.free, ranked.candidate.dimensions)};
    ++report_.judged;
    const auto train = lay_out(found.design);
    if (!train) {
      count("layout");
      return std::nullopt;
    }
    if (judge_) found.verdict = judge_(*train);
    State& state = states_[ranked.set_index];
    if (found.verdict.failed.empty()) {
      const EfficiencyResult exact =
          trueflank::efficiency(*train, {.model = LossModel::kPathIntegral});
      found.exact_forward = exact.forward;
      found.exact_backward = exact.backward;
      found.by_formula = exact.by_formula;
      found.reserve = state.reserve;
      return found;
    }
    again = tightened(ranked, set, found.verdict.failed, state);
    if (!again) count(found.verdict.failed.front());
    return std::nullopt;
  }

 private:
  struct State {
    LimitReserve reserve{};
    int tightenings = 0;
  };

  std::optional<RankedCandidate> tightened(const RankedCandidate& ranked, const ToothSet& set,
                                           const std::vector<std::string>& failed, State& state) {
    if (r_.objectives.size() > 1 || state.tightenings == kTightenings) return std::nullopt;
    ++state.tightenings;
    bool mendable = false;
    for (const std::string& check : failed)
      for (const Limit limit : limits_behind(check)) {
        double& reserve = state.reserve[static_cast<std::size_t>(limit)];
        reserve = reserve == 0.0 ? kFirstTightening : 4.0 * reserve;
        mendable = true;
      }
    if (!mendable) return std::nullopt;
    const SetResult result = optimise_set(r_, set, state.reserve);
    report_.evaluations += result.evaluations;
    if (result.candidates.empty()) return std::nullopt;
    return RankedCandidate{ranked.set_index, result.candidates.front(), false};
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
  std::map<std::size_t, State> states_;
};

void count_records(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                   const SearchRecords& records, SearchReport& report) {
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
  std::sort(report.ranking.begin(), report.ranking.end(),
            BetterCandidate{&requirements.objectives});
  mark_front(report.ranking, requirements.objectives);
}

}  // namespace

namespace {

SearchReport judged(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                    const SearchRecords& records, const DesignJudge& judge) {
  SearchReport report;
  count_records(requirements, enumeration, records, report);
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

/// Whether sets that were passed over might be better than a design that is reported: they can be as
/// good as the last one listed.
bool might_lack_one(const SearchRequirements& requirements, const SearchReport& report) {
  if (report.passed_over == 0) return false;
  if (report.designs.size() < static_cast<std::size_t>(requirements.results)) return true;
  const SearchObjective objective = requirements.objectives.front();
  return std::any_of(report.designs.begin(), report.designs.end(), [&](const FoundDesign& found) {
    return found.candidate.merit(objective) < report.ranking.back().candidate.merit(objective);
  });
}

/// How much better the shifts of a design could be at most.
void certify(const SearchRequirements& r, FoundDesign& found) {
  const SearchObjective objective = r.objectives.front();
  const bool forward = objective == SearchObjective::kForward;
  if (r.objectives.size() > 1 || (!forward && objective != SearchObjective::kBackward)) return;
  const DriveDirection direction = forward ? DriveDirection::kForward : DriveDirection::kBackward;
  const SearchModel model(r, found.set);
  const FreeShifts& free = found.candidate.free;
  const double known = model.efficiency(model.layer1(free.centre_distance, free.layer1_shift),
                                        model.layer2(free.centre_distance, free.layer2_shift), direction);
  const double bound = certified_bound(r, found.set, direction, {.known = known}).efficiency;
  const ToldEfficiencies told = told_efficiencies(r, found.set, bound, bound);
  found.certified_bound = forward ? told.forward : told.backward;
  found.certified_gap = std::max(0.0, found.certified_bound - found.candidate.merit(objective));
}

}  // namespace

SearchReport conclude_search(const SearchRequirements& requirements,
                             const SetEnumeration& enumeration, const SearchRecords& records,
                             const DesignJudge& judge) {
  SearchReport report = judged(requirements, enumeration, records, judge);
  SearchRequirements wider = requirements;
  SearchRecords more;
  while (might_lack_one(requirements, report)) {
    wider.listed = static_cast<int>(kMoreListed * listed_sets(wider));
    more = run_search(wider, enumeration,
                      {.done = more.optimised.empty() ? records.optimised : more.optimised});
    report = judged(requirements, enumeration, more, judge);
  }
  for (FoundDesign& found : report.designs) certify(requirements, found);
  for (FoundDesign& found : report.designs)
    found.binding = binding_limits(requirements, found.set, found.candidate, found.reserve,
                                   &found - report.designs.data() < kRelaxed);
  if (!report.designs.empty())
    report.binding_ranges = binding_ranges(requirements, report.designs.front().set, report.designs.front().candidate);
  return report;
}

double FoundDesign::tightened() const { return *std::max_element(reserve.begin(), reserve.end()); }

}  // namespace trueflank
