// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/cure_trial.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/check/profile.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/check/undercut.h"

namespace trueflank {

bool better(const CureTrial& a, const CureTrial& b) {
  if (a.failing != b.failing) return a.failing < b.failing;
  if (a.clean() != b.clean()) return a.clean();
  if (std::abs(a.worrying - b.worrying) > 0.5) return a.worrying < b.worrying;
  return a.cost < b.cost;
}

double tip_cost(const GearTrain& train, const DesignChange& change) {
  double sum = 0.0;
  for (const auto& [i, diameter] : change.tip_diameter_mm)
    sum += 0.5 * std::abs(diameter - 2.0 * train.gears[i].profile.gear().tip_radius_mm) /
           train.design.module_mm;
  return sum;
}

bool shifts_fit(const GearTrain& train) {
  return std::all_of(train.meshes.begin(), train.meshes.end(), [&](const TrainMesh& mesh) {
    const double implied = mesh.implied_backlash_mm / train.design.module_mm;
    return implied > -1e-4 && implied < 0.25;
  });
}

std::set<std::string> warned_gears(const GearTrain& train, int layer) {
  std::set<std::string> places;
  for (const auto check : {check_profile, check_undercut, check_tip_thickness})
    for (const Finding& f : check(train)) {
      const TrainGear* gear = train.find(f.where);
      if (f.status == CheckStatus::kWarn && gear && (layer == 0 || gear->layer == layer))
        places.insert(f.id + "@" + f.where);
    }
  return places;
}

int count_of(const Findings& findings, CheckStatus status) {
  return static_cast<int>(std::count_if(findings.begin(), findings.end(),
                                        [&](const Finding& f) { return f.status == status; }));
}

bool any_newly_fails(const Findings& before, const Findings& after,
                     const std::set<std::string>& ids_around) {
  const auto passed = [&](const Finding& asked) {
    return std::any_of(before.begin(), before.end(), [&](const Finding& f) {
      return f.id == asked.id && f.where == asked.where && f.status == CheckStatus::kPass;
    });
  };
  return std::any_of(after.begin(), after.end(), [&](const Finding& f) {
    return f.status == CheckStatus::kFail && !ids_around.contains(f.id) && passed(f);
  });
}

std::string conflict_text(const FailedTogether& failed, const Findings& left) {
  if (failed.empty()) {  // no change of these teeth could even be laid out
    const auto failing = std::find_if(
        left.begin(), left.end(), [](const Finding& f) { return f.status == CheckStatus::kFail; });
    return failing == left.end() ? "" : "nothing near this design clears " + failing->id;
  }
  // the fewest checks first, then those that failed most often
  std::vector<std::pair<std::set<std::string>, int>> sets(failed.begin(), failed.end());
  std::stable_sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
    return a.first.size() != b.first.size() ? a.first.size() < b.first.size() : a.second > b.second;
  });
  const std::set<std::string>& fewest = sets.front().first;
  const std::string& first = *fewest.begin();
  if (fewest.size() > 1)
    return first + " and " + *std::next(fewest.begin()) +
           " fail together in every design near this one";
  if (sets.size() > 1 && sets[1].first.size() == 1)
    return first + " and " + *sets[1].first.begin() +
           " contradict each other near this design: what clears one fails the other";
  return "nothing near this design clears " + first;
}

}  // namespace trueflank
