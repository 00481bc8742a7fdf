// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "trueflank/search/search.h"

namespace trueflank {

/// The one set of these tooth numbers, whether or not its planets are all alike.
inline ToothSet set_of(SearchRequirements r, int s, int p1, int r1, int p2, int r2) {
  r.sun = {s, s};
  r.planet1 = {p1, p1};
  r.ring1 = {r1, r1};
  r.planet2 = {p2, p2};
  r.ring2 = {r2, r2};
  r.identical_planets = false;
  const SetEnumeration found = enumerate_sets(r);
  if (found.sets.size() != 1) throw std::runtime_error(std::to_string(found.sets.size()) + " sets instead of one");
  return found.sets.front();
}

}  // namespace trueflank
