// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/search/search.h"

namespace trueflank {

/// Best first by the first objective, then the others, then the set: a total order.
struct BetterCandidate {
  const std::vector<SearchObjective>* objectives;
  bool operator()(const RankedCandidate& p, const RankedCandidate& q) const;
};

/// Judges what a report ranks (of several objectives what is on the front) from the best downwards,
/// until enough designs pass, and adds these and what fell to the report. A design that fails a
/// check is optimised again with more distance from the limits behind it, and takes the place in
/// the ranking that it then has.
void judge_best(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                const DesignJudge& judge, SearchReport& report);

}  // namespace trueflank
