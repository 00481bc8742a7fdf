// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <map>
#include <set>
#include <string>

#include "trueflank/check/cure/design_change.h"
#include "trueflank/check/finding.h"

// What the joint cure knows of a change it tried, and how changes and designs are compared.
namespace trueflank {

/// A change with what quick judges say of it.
struct CureTrial {
  DesignChange change;
  double cost = std::numeric_limits<double>::infinity();  ///< modules, of tips, too
  double failing = std::numeric_limits<double>::infinity(),
         worrying = std::numeric_limits<double>::infinity();  ///< as in contact_judgement.h
  [[nodiscard]] bool passes() const { return failing == 0.0; }
  [[nodiscard]] bool clean() const { return passes() && worrying == 0.0; }
};

/// Cleaner first, then smaller: what fails less; what neither fails nor warns; half a warning less;
/// what costs less.
[[nodiscard]] bool better(const CureTrial& a, const CureTrial& b);

/// What is taken off tips or added to them, in modules; the change's other costs are
/// DesignChange::cost().
[[nodiscard]] double tip_cost(const GearTrain& train, const DesignChange& change);

/// Whether the shifts and the centre distance of a train fit each other: backlash above 0 and below
/// a quarter of the module.
[[nodiscard]] bool shifts_fit(const GearTrain& train);

/// Check and gear ("undercut@sun") of what warns about the gears of a layer by themselves; 0: of
/// all.
[[nodiscard]] std::set<std::string> warned_gears(const GearTrain& train, int layer);

[[nodiscard]] int count_of(const Findings& findings, CheckStatus status);

/// A check that passed fails now; those with the ids of parts around the gears do not count, as
/// these may have to follow by hand.
[[nodiscard]] bool any_newly_fails(const Findings& before, const Findings& after,
                                   const std::set<std::string>& ids_around);

/// How many designs failed by exactly these checks.
using FailedTogether = std::map<std::set<std::string>, int>;

/// What contradicts what, in words; `left`: the findings in the end. Empty where nothing fails.
[[nodiscard]] std::string conflict_text(const FailedTogether& failed, const Findings& left);

}  // namespace trueflank
