// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_listing.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace trueflank {

Merits merits_of(const SearchCandidate& candidate, const std::vector<SearchObjective>& objectives) {
  Merits merits;
  for (const SearchObjective objective : objectives) merits.push_back(candidate.merit(objective));
  return merits;
}

bool dominates(const Merits& p, const Merits& q) {
  bool better = false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[i] < q[i]) return false;
    better = better || p[i] > q[i];
  }
  return better;
}

Listing::Listing(std::size_t listed, double better_than)
    : listed_(listed), better_than_(better_than) {}

void Listing::add(std::vector<Merits> designs) {
  if (listed_ == 0 || designs.empty()) return;
  ++known_;
  if (designs.front().size() == 1) {
    best_.insert(std::max_element(designs.begin(), designs.end())->front());
    if (best_.size() > listed_) best_.erase(best_.begin());
    return;
  }
  // what an excluded set beats, as many others beat too
  if (std::all_of(designs.begin(), designs.end(), [&](const Merits& m) { return excludes(m); }))
    return;
  sets_.push_back(std::move(designs));
}

double Listing::least() const {
  const double least =
      better_than_ == better_than_ ? better_than_ : -std::numeric_limits<double>::infinity();
  return listed_ > 0 && best_.size() == listed_ ? std::max(least, *best_.begin()) : least;
}

bool Listing::excludes(const Merits& merits) const {
  if (listed_ == 0) return false;
  if (merits.size() == 1) return merits.front() < least();
  std::size_t better = 0;
  for (const std::vector<Merits>& designs : sets_) {
    better += std::any_of(designs.begin(), designs.end(),
                          [&](const Merits& m) { return dominates(m, merits); });
    if (better == listed_) return true;
  }
  return false;
}

}  // namespace trueflank
