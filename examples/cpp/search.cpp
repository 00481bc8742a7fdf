// SPDX-License-Identifier: GPL-3.0-or-later
// Searches tooth numbers and profile shifts of a 3K gearbox near 96:1 and shows the best.
#include <cstdio>

#include "trueflank/session/search_session.h"

int main() {
  using namespace trueflank;
  SearchRequirements wanted;
  wanted.ratio_min = 90.0;
  wanted.ratio_max = 100.0;
  wanted.sun = {12, 12};
  wanted.planet1 = {39, 39};
  wanted.ring1 = {90, 90};
  wanted.planet2 = {31, 33};
  wanted.ring2 = {80, 82};
  wanted.results = 3;

  const SearchTask task{.requirements = wanted, .enumeration = enumerate_sets(wanted)};
  const SearchReport found = finish_search(task, run_search(task.requirements, task.enumeration));
  std::printf("%lld sets considered, %zu optimised\n", found.considered, found.optimised);
  for (const FoundDesign& design : found.designs)
    std::printf("%d/%d/%d/%d/%d: ratio %.2f, forward %.2f %%, backward %.2f %%\n", design.set.sun,
                design.set.planet1, design.set.ring1, design.set.planet2, design.set.ring2,
                signed_ratio(design.set), 100.0 * design.exact_forward,
                100.0 * design.exact_backward);
  return found.designs.empty() ? 1 : 0;
}
