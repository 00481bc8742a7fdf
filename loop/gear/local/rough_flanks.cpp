// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/rough_flanks.h"

#include <algorithm>
#include <optional>

namespace trueflank::loop {

RoughFlanks rough_flanks(const Courses& courses) {
  std::array<std::vector<std::vector<ValueAlong>>, 2> of_side;
  for (std::size_t side = 0; side < of_side.size(); ++side)
    for (const auto& [course, samples] : courses.of_flank[side]) {
      std::vector<ValueAlong>& trace = of_side[side].emplace_back();
      for (const RemainderSample& sample : samples)
        trace.push_back({(sample.at - courses.low) / (courses.high - courses.low), sample.um});
      std::stable_sort(trace.begin(), trace.end(),
                       [](const auto& a, const auto& b) { return a.at < b.at; });
    }
  std::vector<std::vector<ValueAlong>> both = of_side[0];
  both.insert(both.end(), of_side[1].begin(), of_side[1].end());
  RoughFlanks surest;
  int asked = 0;
  for (const int side : {-1, 0, 1}) {
    const auto& traces = side < 0 ? both : of_side[static_cast<std::size_t>(side)];
    if (traces.empty() || (side >= 0 && traces.size() == both.size())) continue;
    ++asked;
    const std::optional<RoughZone> zone = rough_zone(traces);
    if (zone && zone->p_value < surest.zone.p_value) surest = {side, *zone};
  }
  surest.zone.p_value = std::min(1.0, asked * surest.zone.p_value);
  return surest;
}

}  // namespace trueflank::loop
