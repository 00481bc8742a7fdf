// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/needed_changes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace trueflank {
namespace {

/// One key, or keys that stand for one thing, taken over from another design.
using TakeOver = std::function<void(GearboxDesign& to, const GearboxDesign& from)>;
/// One number moved: share 0 is the old design's, 1 the new one's.
using MoveBack = std::function<void(GearboxDesign& to, double share)>;

std::set<std::string> places(const Findings& findings, CheckStatus status) {
  std::set<std::string> result;
  for (const Finding& f : findings)
    if (f.status == status) result.insert(f.id + "@" + f.where);
  return result;
}

bool no_worse(const Findings& after, const Findings& before) {
  const auto within = [&](CheckStatus status) {
    const auto allowed = places(before, status);
    const auto found = places(after, status);
    return std::all_of(found.begin(), found.end(),
                       [&](const auto& place) { return allowed.contains(place); });
  };
  return within(CheckStatus::kFail) && within(CheckStatus::kWarn);
}

/// The most expensive first.
std::vector<TakeOver> keys_of(const GearboxDesign& design) {
  using D = GearboxDesign;
  std::vector<TakeOver> keys{[](D& to, const D& from) { to.planets = from.planets; }};
  const auto of_each_gear = [&](auto member) {
    for (std::size_t i = 0; i < design.gears.size(); ++i)
      keys.emplace_back(
          [i, member](D& to, const D& from) { to.gears[i].*member = from.gears[i].*member; });
  };
  of_each_gear(&GearDesign::teeth);
  keys.emplace_back([](D& to, const D& from) { to.rack = from.rack; });
  keys.emplace_back([](D& to, const D& from) { to.rack.pressure_angle_rad = from.rack.pressure_angle_rad; });
  keys.emplace_back([](D& to, const D& from) { to.rack.dedendum = from.rack.dedendum; });
  keys.emplace_back([](D& to, const D& from) { to.rack.addendum = from.rack.addendum; });
  keys.emplace_back([](D& to, const D& from) { to.rack.root_radius = from.rack.root_radius; });
  keys.emplace_back([](D& to, const D& from) { to.backlash_mm = from.backlash_mm; });
  keys.emplace_back([](D& to, const D& from) { to.centre_distance_mm = from.centre_distance_mm; });
  keys.emplace_back([](D& to, const D& from) { to.layer_gap_mm = from.layer_gap_mm; });
  of_each_gear(&GearDesign::tip_diameter_mm);
  of_each_gear(&GearDesign::shift);
  keys.emplace_back([](D& to, const D& from) { to.tips = from.tips; });
  keys.emplace_back([](D& to, const D& from) { to.machine = from.machine; });
  keys.emplace_back([](D& to, const D& from) {
    for (std::size_t i = 0; i < to.gears.size(); ++i) to.gears[i].shift = from.gears[i].shift;
  });
  return keys;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

/// Numbers that may stop half way, as they are written.
std::vector<MoveBack> numbers_of(const GearTrain& before, const GearboxDesign& after) {
  const GearboxDesign& old = before.design;
  const auto between = [](double from, double to, double share) {
    return rounded(from + share * (to - from), 1e4);
  };
  std::vector<MoveBack> numbers;
  if (after.backlash_mm != old.backlash_mm)
    numbers.emplace_back([=](GearboxDesign& d, double share) {
      d.backlash_mm = between(old.backlash_mm, after.backlash_mm, share);
    });
  if (after.rack.addendum != old.rack.addendum)
    numbers.emplace_back([=](GearboxDesign& d, double share) {
      d.rack.addendum = between(old.rack.addendum, after.rack.addendum, share);
    });
  if (after.rack.root_radius != old.rack.root_radius)
    numbers.emplace_back([=](GearboxDesign& d, double share) {
      d.rack.root_radius = between(old.rack.root_radius, after.rack.root_radius, share);
    });
  if (after.centre_distance_mm && after.centre_distance_mm != old.centre_distance_mm)
    numbers.emplace_back([=, a = before.centre_distance_mm](GearboxDesign& d, double share) {
      d.centre_distance_mm = between(a, *after.centre_distance_mm, share);
    });
  if (after.layer_gap_mm != old.layer_gap_mm)
    numbers.emplace_back([=](GearboxDesign& d, double share) {
      d.layer_gap_mm = between(old.layer_gap_mm, after.layer_gap_mm, share);
    });
  for (std::size_t i = 0; i < after.gears.size(); ++i)
    if (after.gears[i].shift && after.gears[i].shift != old.gears[i].shift)
      numbers.emplace_back([=, x = before.gears[i].shift](GearboxDesign& d, double share) {
        d.gears[i].shift = between(x, *after.gears[i].shift, share);
      });
  return numbers;
}

class Reduction {
 public:
  Reduction(const GearTrain& before, JudgedDesign changed, const DesignJudge& judge,
            int most_judged)
      : before_(before), best_(std::move(changed)), judge_(judge), left_(most_judged) {}

  JudgedDesign run() {
    while (take_back_keys() && left_ > 0) {
    }
    if (!move_numbers()) return std::move(best_);
    while (take_back_keys() && left_ > 0) {  // one key taken back may free another
    }
    return std::move(best_);
  }

 private:
  bool accept(const GearboxDesign& candidate) {
    if (candidate == best_.design || left_ <= 0) return false;
    --left_;
    auto findings = judge_(candidate);
    if (!findings || !no_worse(*findings, best_.findings)) return false;
    best_ = {candidate, std::move(*findings)};
    return true;
  }

  bool take_back_keys() {
    bool any = false;
    for (const TakeOver& key : keys_of(before_.design)) {
      GearboxDesign candidate = best_.design;
      key(candidate, before_.design);
      any = accept(candidate) || any;
    }
    return any;
  }

  bool move_numbers() {
    bool any = false;
    for (const MoveBack& number : numbers_of(before_, best_.design)) {
      double needed = 1.0;
      for (double step = 0.5; step > 0.1; step *= 0.5) {
        GearboxDesign candidate = best_.design;
        number(candidate, needed - step);
        if (accept(candidate)) {
          needed -= step;
          any = true;
        }
      }
    }
    return any;
  }

  const GearTrain& before_;
  JudgedDesign best_;
  const DesignJudge& judge_;
  int left_;
};

}  // namespace

JudgedDesign with_needed_changes(const GearTrain& before, JudgedDesign changed,
                                 const DesignJudge& judge, int most_judged) {
  return Reduction(before, std::move(changed), judge, most_judged).run();
}

}  // namespace trueflank
