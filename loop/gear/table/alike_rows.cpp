// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/alike_rows.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace trueflank::loop {

AlikeRows alike_rows(const Observations& table, const std::vector<std::uint32_t>& rows) {
  const auto is_one_flank = [&](const Observation& row) {
    return row.places == 1 && table.place(row).surface == Surface::kFlank;
  };
  using Key = std::tuple<bool, int, double, double, double>;
  const auto key = [&](const Observation& row) {
    const Place& place = table.place(row);
    return Key{is_one_flank(row), place.side, place.roll_mm, place.z_mm, row.weight};
  };
  std::vector<std::uint32_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return key(table.rows[rows[a]]) < key(table.rows[rows[b]]);
  });
  AlikeRows alike;
  alike.kind.resize(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Observation& row = table.rows[rows[order[i]]];
    if (i == 0 || !is_one_flank(row) || key(row) != key(table.rows[rows[order[i - 1]]]))
      alike.first.push_back(rows[order[i]]);
    alike.kind[order[i]] = static_cast<std::uint32_t>(alike.first.size() - 1);
  }
  return alike;
}

}  // namespace trueflank::loop
