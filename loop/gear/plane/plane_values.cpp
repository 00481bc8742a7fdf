// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/plane_values.h"

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {

PlaneValues values_in_plane(const FlankGeometry& geometry, const Observations& table,
                            const std::vector<float>& row_um,
                            const std::vector<std::uint32_t>& rows) {
  constexpr std::size_t kRowsAsked = 3000;
  PlaneValues values;
  values.rows = rows.size();
  const ThinnedRows some(values.rows, kRowsAsked);
  double sum = 0.0;
  for (const std::uint32_t i : rows) {
    if (!some.has(i)) continue;
    const Place& place = table.place(table.rows[i]);
    values.um.push_back(row_um[i]);
    sum += row_um[i];
    values.at_mm[0].push_back(place.radius_mm * place.polar_direction[0]);
    values.at_mm[1].push_back(place.radius_mm * place.polar_direction[1]);
    values.normal[0].push_back(normal_part(geometry, place, 1.0, 0.0));
    values.normal[1].push_back(normal_part(geometry, place, 0.0, 1.0));
    values.flank.push_back(2 * (place.tooth - 1) + (place.side > 0 ? 1 : 0));
  }
  if (values.um.empty()) return values;
  values.mean_um = sum / static_cast<double>(values.um.size());
  for (double& um : values.um) um -= values.mean_um;
  return values;
}

}  // namespace trueflank::loop
