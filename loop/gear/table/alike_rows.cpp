// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/alike_rows.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <tuple>

namespace trueflank::loop {

AlikeRows alike_rows(const Observations& table, const std::vector<std::uint32_t>& rows) {
  /// What tells a row from others, and where it stands; by the first it is sorted, then by that.
  struct Sorted {
    bool is_one_flank = false;
    std::int8_t side = 0;
    double roll_mm = 0.0, z_mm = 0.0, weight = 0.0;
    std::uint32_t at = 0;
    [[nodiscard]] bool is_alike(const Sorted& other) const {
      return is_one_flank && other.is_one_flank && side == other.side && roll_mm == other.roll_mm &&
             z_mm == other.z_mm && weight == other.weight;
    }
    auto operator<=>(const Sorted&) const = default;
  };
  std::vector<Sorted> sorted(rows.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const Observation& row = table.rows[rows[i]];
    const Place& place = table.place(row);
    sorted[i] = {row.places == 1 && place.surface == Surface::kFlank,
                 place.side,
                 place.roll_mm,
                 place.z_mm,
                 row.weight,
                 i};
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const Sorted& a, const Sorted& b) { return std::is_lt(a <=> b); });
  AlikeRows alike;
  alike.kind.resize(rows.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || !sorted[i].is_alike(sorted[i - 1])) alike.first.push_back(rows[sorted[i].at]);
    alike.kind[sorted[i].at] = static_cast<std::uint32_t>(alike.first.size() - 1);
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
