// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/gear/several_parts.h"

namespace trueflank::loop {

Observations joined_table(const std::vector<const Observations*>& tables) {
  Observations all;
  for (const Observations* table : tables) {
    all.poses.insert(all.poses.end(), table->poses.begin(), table->poses.end());
    all.pose_is_free.insert(all.pose_is_free.end(), table->pose_is_free.begin(),
                            table->pose_is_free.end());
    all.points_mm.insert(all.points_mm.end(), table->points_mm.begin(), table->points_mm.end());
    all.outliers += table->outliers;
    if (table->size_degrees > 0 &&
        (all.size_degrees == 0 || table->size_degrees < all.size_degrees))
      all.size_degrees = table->size_degrees;
    all.is_displaced = all.is_displaced || table->is_displaced;
  }
  const int scans = static_cast<int>(all.poses.size());
  std::vector<std::size_t> first_place;
  for (const Observations* table : tables) {
    first_place.push_back(all.places.size());
    if (!table->sigmas_um.empty()) {
      all.sigmas_um.resize(all.places.size(), kNaN);
      all.sigmas_um.insert(all.sigmas_um.end(), table->sigmas_um.begin(), table->sigmas_um.end());
    }
    all.places.insert(all.places.end(), table->places.begin(), table->places.end());
  }
  for (const bool of_scans : {true, false}) {
    int first_source = of_scans ? 0 : scans, first_trace = 0;
    for (std::size_t t = 0; t < tables.size(); ++t) {
      const Observations& table = *tables[t];
      const int own = static_cast<int>(table.poses.size());
      const std::size_t middle = table.points_mm.size();
      int most = -1;
      for (std::size_t i = of_scans ? 0 : middle; i < (of_scans ? middle : table.rows.size());
           ++i) {
        Observation row = table.rows[i];
        row.first_place += static_cast<std::uint32_t>(first_place[t]);
        const int source = of_scans ? row.source : row.source - own;
        most = std::max(most, source);
        row.source = first_source + source;
        if (row.trace >= 0) row.trace += first_trace;
        all.rows.push_back(row);
      }
      first_source += of_scans ? own : most + 1;
      first_trace += table.traces;
      if (!of_scans) all.traces += table.traces;
    }
  }
  return all;
}

}  // namespace trueflank::loop
