// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_relax.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "trueflank/search/search.h"
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

/// A design this close to a limit stands on it: in modules, or as a share of a figure.
constexpr double kStands = 1e-4;
constexpr double kShiftStep = 0.1, kContactRatioStep = 0.05;
constexpr double kFigureStep = 0.1;  ///< share of the figure
constexpr double kRatioStep = 0.01;  ///< share of the ratio

/// How a key is relaxed; no `apply`: it cannot be.
struct Relaxation {
  std::string key;
  double value = kNaN, relaxed = kNaN;
  std::function<void(SearchRequirements&, double)> apply;
};

Relaxation of_shift(const SearchRequirements& r, bool greatest) {
  if (greatest)
    return {"shift.max", r.shift_max, r.shift_max + kShiftStep,
            [](SearchRequirements& q, double v) { q.shift_max = v; }};
  return {"shift.min", r.shift_min, r.shift_min - kShiftStep,
          [](SearchRequirements& q, double v) { q.shift_min = v; }};
}

/// Half of a clearance; what is 0 already is left to the teeth's own shape.
Relaxation halved(const char* key, double value,
                  std::function<void(SearchRequirements&, double)> apply) {
  if (!(value > 0.0)) return {};
  return {key, value, 0.5 * value, std::move(apply)};
}

Relaxation of_contact_ratio(const SearchRequirements& r, bool least) {
  if (!least)
    return {"limits.contact_ratio_max", r.contact_ratio_max, r.contact_ratio_max + kContactRatioStep,
            [](SearchRequirements& q, double v) { q.contact_ratio_max = v; }};
  if (r.contact_ratio_min <= 1.0) return {};  // contact would be interrupted
  return {"limits.contact_ratio_min", r.contact_ratio_min,
          std::max(1.0, r.contact_ratio_min - kContactRatioStep),
          [](SearchRequirements& q, double v) { q.contact_ratio_min = v; }};
}

/// Of a margin; `upper`: the second of two of the same limit.
Relaxation relaxation_of(const SearchRequirements& r, Limit limit, bool upper) {
  switch (limit) {
    case Limit::kShift:
      return of_shift(r, upper);
    case Limit::kContactRatio:
      return of_contact_ratio(r, !upper);
    case Limit::kFillet:
    case Limit::kTrochoid:
      return halved("limits.clearance_um", r.clearance_um,
                    [](SearchRequirements& q, double v) { q.clearance_um = v; });
    case Limit::kTipClearance:
      return halved("limits.tip_clearance", r.tip_clearance,
                    [](SearchRequirements& q, double v) { q.tip_clearance = v; });
    case Limit::kTipThickness:
      return halved("limits.tip_thickness", r.tip_thickness,
                    [](SearchRequirements& q, double v) { q.tip_thickness = v; });
    case Limit::kPlanetSpacing:
      return halved("limits.planet_clearance_mm", r.planet_clearance_mm,
                    [](SearchRequirements& q, double v) { q.planet_clearance_mm = v; });
    case Limit::kRingTip:
      break;
  }
  return {};
}

Relaxation relaxation_of(const FigureLimit& limit, std::size_t index, bool torque) {
  const ObjectiveEntry& entry = objective_entry(limit.figure);
  const double share = entry.larger_is_better ? 1.0 - kFigureStep : 1.0 + kFigureStep;
  return {entry.limit_key, limit.value, share * limit.value, [=](SearchRequirements& q, double v) {
            if (torque)
              q.output_torque_nm = v;
            else
              q.figure_limits[index].value = v;
          }};
}

/// The tooth numbers of a set alone.
SearchRequirements of_set_alone(SearchRequirements r, const ToothSet& set) {
  const auto only = [](int teeth) { return teeth ? ToothRange{teeth, teeth} : ToothRange{6, 6}; };
  r.kinds = {set.train->kind()};
  r.inputs = {set.train->input};
  r.outputs = {set.train->output};
  r.internal_wheels = set.train->internal_wheel;
  r.external_wheels = !set.train->internal_wheel;
  r.planets = {set.planets};
  r.layer2_module_ratios = {set.layer2_module_ratio};
  r.sun = only(set.sun), r.planet1 = only(set.planet1), r.ring1 = only(set.ring1);
  r.planet2 = only(set.planet2), r.ring2 = only(set.ring2);
  r.planet = r.ring = r.pinion = r.wheel = {};
  if (set.train->stage > 0) {  // whatever its partner
    r.planet2 = r.planet1, r.ring2 = r.ring1;
    r.ratio_min = 0.0, r.ratio_max = 1e9;
  }
  return r;
}

/// The set with the centre distances that other requirements leave it.
std::optional<ToothSet> within(const SearchRequirements& r, const ToothSet& set) {
  const SetEnumeration found = enumerate_sets(of_set_alone(r, set));
  for (const ToothSet& stage : found.stages)
    if (stage.train == set.train) return stage;
  if (found.sets.size() != 1) return std::nullopt;
  return found.sets.front();
}

class Binding {
 public:
  Binding(const SearchRequirements& r, const ToothSet& set, const SearchCandidate& candidate,
          const LimitReserve& reserve)
      : r_(r), set_(set), candidate_(candidate), reserve_(reserve), values_(r, set, reserve) {}

  std::vector<BindingLimit> run(bool costs) {
    margins();
    shifts();
    figures();
    for (std::size_t i = 0; costs && i < found_.size(); ++i) found_[i].objective = relaxed(relaxations_[i]);
    return std::move(found_);
  }

 private:
  void add(const std::string& limit, const std::string& where, Relaxation relaxation) {
    for (BindingLimit& known : found_) {
      if (known.limit != limit || known.key != relaxation.key) continue;
      if ((", " + known.where + ",").find(", " + where + ",") == std::string::npos)
        known.where += ", " + where;
      return;
    }
    found_.push_back({limit, where, relaxation.key, relaxation.value, relaxation.relaxed});
    relaxations_.push_back(std::move(relaxation));
  }

  void margins() {
    std::vector<double> margins(kLimits);
    values_.margins(values_.state(candidate_.free), margins.data());
    const auto& limits = set_.train->limits;
    std::size_t same = 0;  // how many of this limit at this place come before
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const bool again = i > 0 && limits[i].limit == limits[i - 1].limit && limits[i].where == limits[i - 1].where;
      same = again ? same + 1 : 0;
      if (margins[i] < kStands) add(to_text(limits[i].limit), limits[i].where, relaxation_of(r_, limits[i].limit, same == 1));
    }
  }

  /// The free shifts' own bounds are in no margin.
  void shifts() {
    const GearboxDesign design = values_.model().design(candidate_.free);
    for (const GearDesign& gear : design.gears) {
      if (*gear.shift < r_.shift_min + kStands) add(to_text(Limit::kShift), gear.name, of_shift(r_, false));
      if (*gear.shift > r_.shift_max - kStands) add(to_text(Limit::kShift), gear.name, of_shift(r_, true));
    }
  }

  void figures() {
    const auto asked = asked_limits(r_);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const double off = std::abs(candidate_.value(asked[i].figure) - asked[i].value);
      const bool torque = r_.output_torque_nm && i == 0;
      if (off < kStands * std::abs(asked[i].value))
        add(to_text(asked[i].figure), "", relaxation_of(asked[i], torque ? 0 : i - (r_.output_torque_nm ? 1 : 0), torque));
    }
  }

  double relaxed(const Relaxation& relaxation) const {
    if (!relaxation.apply) return kNaN;
    SearchRequirements other = r_;
    other.objectives = {r_.objectives.front()};  // what is told is its best alone
    relaxation.apply(other, relaxation.relaxed);
    const auto set = within(other, set_);
    if (!set) return kNaN;
    const SetResult result = optimise_set(other, *set, reserve_);
    if (result.candidates.empty()) return kNaN;
    const SearchObjective objective = r_.objectives.front();
    const SearchCandidate& best = result.candidates.front();
    // the design itself keeps the wider limits too
    return best.merit(objective) > candidate_.merit(objective) ? best.value(objective)
                                                               : candidate_.value(objective);
  }

  const SearchRequirements& r_;
  const ToothSet& set_;
  const SearchCandidate& candidate_;
  const LimitReserve& reserve_;
  SetValues values_;
  std::vector<BindingLimit> found_;
  std::vector<Relaxation> relaxations_;
};

bool is_efficiency(const std::vector<SearchObjective>& objectives) {
  return objectives == std::vector{SearchObjective::kForward} ||
         objectives == std::vector{SearchObjective::kBackward};
}

/// Of the sets of some requirements that may be better than a merit; NaN where none is.
double best_of(SearchRequirements r, double than) {
  r.listed = r.results = 1;
  double best = kNaN;
  SetEnumeration enumeration = enumerate_sets(r);
  enumeration.stages.clear();  // of trains in series, which are no sets
  for (const SearchRecords found = run_search(r, enumeration, {.threads = 1, .better_than = than});
       const SearchRecord& record : found.optimised)
    for (const SearchCandidate& c : record.result.candidates) {
      const double value = c.value(r.objectives.front());
      if (!(value <= best)) best = value;
    }
  return best;
}

/// The requirements with another range of a gear's teeth, under the name it has in its kind.
SearchRequirements with_range(SearchRequirements r, const ToothSet& set, const std::string& name,
                              const ToothRange& range) {
  using R = SearchRequirements;
  static const std::map<std::string, ToothRange R::*> kOfLayers{{"sun", &R::sun},
                                                                {"planet1", &R::planet1},
                                                                {"ring1", &R::ring1},
                                                                {"planet2", &R::planet2},
                                                                {"ring2", &R::ring2}};
  static const std::map<std::string, OpenToothRange R::*> kOwn{
      {"planet", &R::planet}, {"ring", &R::ring}, {"pinion", &R::pinion}, {"wheel", &R::wheel}};
  if (const auto own = kOwn.find(name); own != kOwn.end()) {
    r.kinds = {set.train->kind()};  // others have the range as it was
    r.*(own->second) = {range.min, range.max};
  } else {
    r.*(kOfLayers.at(name)) = range;
  }
  return r;
}

}  // namespace

std::vector<BindingLimit> binding_limits(const SearchRequirements& requirements, const ToothSet& set,
                                         const SearchCandidate& candidate,
                                         const LimitReserve& reserve, bool costs) {
  return Binding(requirements, set, candidate, reserve).run(costs);
}

std::vector<BindingLimit> binding_ranges(const SearchRequirements& r, const ToothSet& set,
                                         const SearchCandidate& candidate) {
  std::vector<BindingLimit> found;
  if (listed_sets(r) == 0 || !is_efficiency(r.objectives)) return found;
  const double here = candidate.value(r.objectives.front());
  const auto add = [&](BindingLimit limit, const SearchRequirements& beyond) {
    limit.objective = best_of(beyond, here);
    if (limit.objective > here) found.push_back(std::move(limit));
  };
  for (const TrainPlace place : set.train->places()) {
    const std::string& name = set.train->name_at(place);
    const int teeth = set.teeth_at(place);
    const bool ring = place == TrainPlace::kRing1 || place == TrainPlace::kRing2;
    const ToothRange asked = tooth_range(r, *set.train, place);
    if (asked.min == asked.max) continue;  // wished, no limit
    const auto look = [&](const char* end, int farthest, const ToothRange& range) {
      add({"teeth", name, "teeth." + name + end, 1.0 * teeth, 1.0 * farthest},
          with_range(r, set, name, range));
    };
    const int most = teeth + set.planets, fewest = std::max(ring ? 6 : 4, teeth - set.planets);
    if (teeth == asked.max && most <= 1000) look("_max", most, {teeth + 1, most});
    if (teeth == asked.min && fewest < teeth) look("_min", fewest, {fewest, teeth - 1});
  }
  const double ratio = std::abs(signed_ratio(set));
  SearchRequirements beyond = r;
  if (ratio < r.ratio_min * (1.0 + kRatioStep) && r.ratio_min * (1.0 - kRatioStep) > 1.0) {
    beyond.ratio_max = std::nextafter(r.ratio_min, 0.0);
    beyond.ratio_min = r.ratio_min * (1.0 - kRatioStep);
    add({"ratio", "", "ratio.min", r.ratio_min, beyond.ratio_min}, beyond);
  }
  if (ratio > r.ratio_max * (1.0 - kRatioStep)) {
    beyond.ratio_min = std::nextafter(r.ratio_max, 1e300);
    beyond.ratio_max = r.ratio_max * (1.0 + kRatioStep);
    add({"ratio", "", "ratio.max", r.ratio_max, beyond.ratio_max}, beyond);
  }
  return found;
}

}  // namespace trueflank
