// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/search/search_certify.h"
#include "trueflank/search/search_judging.h"
#include "trueflank/search/search_listing.h"
#include "trueflank/search/search_stage_pairs.h"
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

/// So many times as many sets are listed where those listed do not do.
constexpr std::size_t kMoreListed = 4;
/// Designs of which is computed what their limits cost: each takes as long as a few tooth sets.
constexpr std::ptrdiff_t kRelaxed = 5;

void mark_front(std::vector<RankedCandidate>& ranking,
                const std::vector<SearchObjective>& objectives) {
  // best first by the first objective: only those before can dominate; the front so far suffices
  std::vector<Merits> front;
  for (RankedCandidate& candidate : ranking) {
    const Merits merits = merits_of(candidate.candidate, objectives);
    candidate.on_front = std::none_of(front.begin(), front.end(),
                                      [&](const Merits& f) { return dominates(f, merits); });
    if (candidate.on_front) front.push_back(merits);
  }
}

void count_records(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                   const SearchRecords& records, const std::vector<RankedPair>& pairs,
                   SearchReport& report) {
  report.considered = enumeration.considered;
  report.classes = enumeration.rejected;
  report.sets = enumeration.sets.size();
  report.optimised = records.sets();
  report.passed_over = records.passed_over;
  report.stages_left = records.stages_left;
  for (const SearchRecord& stage : records.stages) report.evaluations += stage.result.evaluations;
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
  // designs of one set that are worth the same keep their order
  std::stable_sort(report.ranking.begin(), report.ranking.end(),
                   BetterCandidate{&requirements.objectives});
  mark_front(report.ranking, requirements.objectives);
}

SearchReport judged(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                    const SearchRecords& records, const std::vector<RankedPair>& pairs,
                    const DesignJudge& judge) {
  SearchReport report;
  count_records(requirements, enumeration, records, pairs, report);
  judge_best(requirements, enumeration, judge, report);
  return report;
}

/// Whether sets that were passed over might be better than a design that is reported: they can be
/// as good as the last one listed.
bool might_lack_one(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                    const SearchReport& report) {
  if (report.passed_over == 0 || requirements.objectives.size() > 1) return false;
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
  if (r.helix_angle_rad != 0.0 || r.cutter) return;  // the intervals are those of hobbed spur teeth
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
  // the whole's efficiency is the product of the stages'; of no other figure
  const bool product = !r.losses && (objective == SearchObjective::kForward ||
                                     objective == SearchObjective::kBackward);
  std::vector<BindingLimit> all;
  for (std::size_t stage = 0; stage < 2; ++stage) {
    const ToothSet& set = found.stages->sets[stage];
    const double other = found.stages->candidates[1 - stage].value(objective);
    for (BindingLimit& b : binding_limits(stage_requirements(r, set), set,
                                          found.stages->candidates[stage], found.reserve,
                                          costs && product)) {
      b.objective = product ? b.objective * other : kNaN;
      all.push_back(std::move(b));
    }
  }
  return all;
}

}  // namespace

SearchReport conclude_search(const SearchRequirements& requirements,
                             const SetEnumeration& enumeration, const SearchRecords& records,
                             const DesignJudge& judge) {
  const std::vector<RankedPair> pairs = best_stage_pairs(
      requirements, enumeration.stages, records.stages, listed_pairs(requirements));
  SearchReport report = judged(requirements, enumeration, records, pairs, judge);
  SearchRequirements wider = requirements;
  SearchRecords more;
  while (might_lack_one(requirements, enumeration, report)) {
    wider.listed = static_cast<int>(kMoreListed * listed_sets(wider));
    SetEnumeration sets = enumeration;
    sets.stages.clear();  // whose pairs are known
    more = run_search(wider, sets,
                      {.done = more.optimised.empty() ? records.optimised : more.optimised});
    more.stages = records.stages;
    more.stages_left = records.stages_left;
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
