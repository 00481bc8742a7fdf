// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/alike_rows.h"

#include <algorithm>
#include <cmath>
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

AlikeRows rows_of_cells(const FlankGeometry& geometry, const Observations& table,
                        const std::vector<std::uint32_t>& rows, FlankCells cells) {
  constexpr int kOther = 8;  // surfaces
  const auto count = static_cast<std::size_t>(2 * cells.profile * cells.face + kOther);
  std::vector<std::int32_t> kind_of(count, -1);
  std::vector<double> off;  // of each kind, of its first row from the middle, in cells
  AlikeRows alike;
  alike.kind.reserve(rows.size());
  const auto own_kind = [&](std::uint32_t row) {
    alike.first.push_back(row);
    off.push_back(0.0);
    return static_cast<std::uint32_t>(alike.first.size() - 1);
  };
  for (const std::uint32_t i : rows) {
    const Observation& row = table.rows[i];
    if (row.places != 1 || row.weight != 1.0) {
      alike.kind.push_back(own_kind(i));
      continue;
    }
    const Place& place = table.place(row);
    std::size_t cell = count - kOther + static_cast<std::size_t>(place.surface) % kOther;
    double from_middle = 0.0;
    if (place.surface == Surface::kFlank) {
      const auto part = [&](double coordinate, int parts) {
        const double at = 0.5 * (coordinate + 1.0) * parts;
        const int k = std::clamp(static_cast<int>(std::floor(at)), 0, parts - 1);
        from_middle = std::max(from_middle, std::abs(at - k - 0.5));
        return k;
      };
      const int profile = part(geometry.profile_coordinate(place.roll_mm), cells.profile);
      const int face = part(geometry.face_coordinate(place.z_mm), cells.face);
      cell = static_cast<std::size_t>(
          ((place.side > 0 ? 1 : 0) * cells.profile + profile) * cells.face + face);
    }
    std::int32_t& kind = kind_of[cell];
    if (kind < 0) {
      kind = static_cast<std::int32_t>(own_kind(i));
      off.back() = from_middle;
    } else if (from_middle < off[static_cast<std::size_t>(kind)]) {
      alike.first[static_cast<std::size_t>(kind)] = i;
      off[static_cast<std::size_t>(kind)] = from_middle;
    }
    alike.kind.push_back(static_cast<std::uint32_t>(kind));
  }
  return alike;
}

}  // namespace trueflank::loop
