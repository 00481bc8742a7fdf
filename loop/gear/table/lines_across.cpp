// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/lines_across.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

void number_lines(const FlankGeometry& geometry, Observations& table) {
  constexpr double kApart = 0.05;  // of -1 ... 1
  // Kind, zero, tooth, side; where a value stands across, and its row.
  std::map<std::array<int, 4>, std::vector<std::pair<double, std::size_t>>> flanks;
  for (std::size_t i = table.points_mm.size(); i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const bool profile = row.kind == ObservationKind::kProfile;
    if (!profile && row.kind != ObservationKind::kHelix) continue;
    const Place& place = table.place(row);
    flanks[{static_cast<int>(row.kind), row.trace, place.tooth, place.side}].emplace_back(
        profile ? geometry.face_coordinate(place.z_mm) : geometry.profile_coordinate(place.roll_mm),
        i);
  }
  for (auto& [flank, values] : flanks) {
    std::stable_sort(values.begin(), values.end());
    std::uint8_t line = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k > 0 && values[k].first - values[k - 1].first > kApart &&
          line < std::numeric_limits<std::uint8_t>::max())
        ++line;
      table.rows[values[k].second].line = line;
    }
  }
}

}  // namespace trueflank::loop
